//! The posture in which a URDF is read: its zero, joints without a role at the angle at which they are held.

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::import::urdf_robot::{JointKind, UrdfRobot, UrdfTreeJoint};

/// Angle at which each joint is held if it has no role (rad, or m for what slides): what the map says, else the angle
/// that the joint it mimics gives it, else zero or the end of its range that is nearest to zero.
pub(super) fn held_angles(robot: &UrdfRobot, told: &[(usize, f64)]) -> Vec<f64> {
    let mut angles: Vec<f64> = robot.joints.iter().map(nearest_to_zero).collect();
    for &(joint, angle) in told {
        angles[joint] = angle;
    }
    let own = angles.clone();
    for (index, joint) in robot.joints.iter().enumerate() {
        let is_told = told.iter().any(|(other, _)| *other == index);
        let followed = joint.mimic.as_ref().filter(|_| !is_told);
        if let Some(mimic) = followed
            && let Some(other) = robot.joints.iter().position(|other| other.name == mimic.joint)
        {
            angles[index] = mimic.factor * own[other] + mimic.offset;
        }
    }
    angles
}

fn nearest_to_zero(joint: &UrdfTreeJoint) -> f64 {
    let has_range = matches!(joint.kind, JointKind::Revolute | JointKind::Prismatic);
    let limit = joint.limit;
    if has_range && limit.lower <= limit.upper { 0.0_f64.clamp(limit.lower, limit.upper) } else { 0.0 }
}

/// Poses of the links and places of the joints, in one frame.
#[derive(Clone, Debug)]
pub(super) struct Poses {
    /// Maps link coordinates to the frame's, for each of the URDF's links.
    pub links: Vec<Isometry3<f64>>,
    /// Origin (m) and axis, for each of the URDF's joints.
    pub joints: Vec<(Vector3<f64>, Unit<Vector3<f64>>)>,
}

impl Poses {
    /// The poses in the root link's frame with each joint at an angle (rad or m).
    pub(super) fn at(robot: &UrdfRobot, angles: &[f64]) -> Self {
        let mut links = vec![None; robot.links.len()];
        links[robot.root] = Some(Isometry3::identity());
        let mut joints = vec![(Vector3::zeros(), Vector3::x_axis()); robot.joints.len()];
        // Links may be in any order: each pass places at least one more.
        for _ in 0..robot.links.len() {
            let mut more = false;
            for (index, joint) in robot.joints.iter().enumerate() {
                if let (Some(parent), None) = (links[joint.parent], links[joint.child]) {
                    let mounted: Isometry3<f64> = parent * joint.origin;
                    links[joint.child] = Some(mounted * moved(joint, angles[index]));
                    joints[index] = (mounted.translation.vector, mounted.rotation * joint.axis);
                    more = true;
                }
            }
            if !more {
                break;
            }
        }
        Self { links: links.into_iter().map(|link| link.unwrap_or_default()).collect(), joints }
    }

    /// The same in another frame; `to` maps coordinates to it.
    pub(super) fn seen_from(&self, to: &Isometry3<f64>) -> Self {
        let joint = |(place, axis): &(Vector3<f64>, Unit<Vector3<f64>>)| {
            (to.rotation * place + to.translation.vector, to.rotation * axis)
        };
        Self {
            links: self.links.iter().map(|link| to * link).collect(),
            joints: self.joints.iter().map(joint).collect(),
        }
    }
}

fn moved(joint: &UrdfTreeJoint, angle: f64) -> Isometry3<f64> {
    match joint.kind {
        JointKind::Revolute | JointKind::Continuous => {
            Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_axis_angle(&joint.axis, angle))
        }
        JointKind::Prismatic => Translation3::from(joint.axis.into_inner() * angle).into(),
        JointKind::Fixed | JointKind::Floating | JointKind::Planar => Isometry3::identity(),
    }
}
