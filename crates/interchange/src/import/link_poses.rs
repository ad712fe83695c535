//! Poses of the URDF's links in the straight posture, with every joint's position and axis, in the root link's frame.

use std::collections::HashMap;

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};
use urdf_rs::{JointType, Pose, Robot};

use crate::import::JointMap;
use crate::import::file_errors::FileErrors;

/// Poses of links and axes of joints of a URDF in the straight posture.
#[derive(Clone, Debug)]
pub(super) struct LinkPoses {
    /// Maps link to root coordinates, for each of the URDF's links.
    pub link_to_root: Vec<Isometry3<f64>>,
    /// Origin (m) and axis of the child link in root coordinates, for each of the URDF's joints.
    pub joints: Vec<(Vector3<f64>, Unit<Vector3<f64>>)>,
    /// Indices of parent and child link, for each of the URDF's joints.
    pub ends: Vec<[usize; 2]>,
}

/// Computes the poses; notes where the URDF is no tree.
pub(super) fn straight(robot: &Robot, map: &JointMap, errors: &mut FileErrors) -> Option<LinkPoses> {
    let index: HashMap<&str, usize> = robot.links.iter().enumerate().map(|(i, link)| (link.name.as_str(), i)).collect();
    let mut find = |joint: &str, link: &str| {
        let found = index.get(link).copied();
        if found.is_none() {
            errors.note(format!("joint {joint}: link {link} must be one of the robot's links"));
        }
        found
    };
    let ends: Vec<Option<[usize; 2]>> = robot
        .joints
        .iter()
        .map(|joint| Some([find(&joint.name, &joint.parent.link)?, find(&joint.name, &joint.child.link)?]))
        .collect();
    let ends: Vec<[usize; 2]> = ends.into_iter().collect::<Option<_>>()?;

    let roots: Vec<usize> = (0..robot.links.len()).filter(|link| ends.iter().all(|[_, child]| child != link)).collect();
    if roots.len() != 1 || ends.len() + 1 != robot.links.len() {
        let names: Vec<&str> = roots.iter().map(|&root| robot.links[root].name.as_str()).collect();
        errors.note(format!(
            "must be one tree: it has {} links, {} joints, and roots [{}]",
            robot.links.len(),
            ends.len(),
            names.join(", ")
        ));
        return None;
    }

    let angle = angles(robot, map);
    let mut link_to_root = vec![None; robot.links.len()];
    link_to_root[roots[0]] = Some(Isometry3::identity());
    let mut joints = vec![(Vector3::zeros(), Vector3::x_axis()); robot.joints.len()];
    // Links may be in any order: each pass places at least one more.
    for _ in 0..robot.links.len() {
        for (place, (joint, [parent, child])) in robot.joints.iter().zip(&ends).enumerate() {
            if let (Some(parent_to_root), None) = (link_to_root[*parent], link_to_root[*child]) {
                let mounted: Isometry3<f64> = parent_to_root * isometry(&joint.origin);
                let axis = Unit::try_new(Vector3::from(joint.axis.xyz.0), 1e-9).unwrap_or(Vector3::x_axis());
                link_to_root[*child] = Some(mounted * UnitQuaternion::from_axis_angle(&axis, angle[place]));
                joints[place] = (mounted.translation.vector, mounted.rotation * axis);
            }
        }
    }
    Some(LinkPoses { link_to_root: link_to_root.into_iter().collect::<Option<_>>()?, joints, ends })
}

/// Angle of each of the URDF's joints in the straight posture (rad); zero for those that do not turn.
fn angles(robot: &Robot, map: &JointMap) -> Vec<f64> {
    let mut angles = vec![0.0; robot.joints.len()];
    for mapped in map.joints.0.iter().flatten() {
        angles[mapped.index] = mapped.straight;
    }
    for &(index, angle) in &map.fixed {
        if matches!(robot.joints[index].joint_type, JointType::Revolute | JointType::Continuous) {
            angles[index] = angle;
        }
    }
    angles
}

/// Converts a URDF pose: a rotation about the fixed axes x, y, z by roll, pitch, yaw, then a translation.
pub(super) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let [roll, pitch, yaw] = pose.rpy.0;
    Isometry3::from_parts(
        Translation3::from(Vector3::from(pose.xyz.0)),
        UnitQuaternion::from_euler_angles(roll, pitch, yaw),
    )
}
