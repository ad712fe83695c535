//! Converts a URDF's tree to the mechanism's: links between its joints are combined, and the tree is rooted at the
//! right foot.

use model::{Joint, PerJoint};
use nalgebra::{Unit, Vector3};
use urdf_rs::{JointType, Robot};

use crate::import::JointMap;
use crate::import::file_errors::FileErrors;
use crate::import::link_poses::LinkPoses;
use crate::import::straight_biped::{Hinge, LumpedBody, StraightBiped, carried};

/// How far an axis may differ from the direction that it should have (rad): the rounding of a URDF's angles.
const AXIS_OFF: f64 = 1e-4;
/// Share of a motor's speed without load at which its joint is used at most.
const NO_LOAD_SHARE: f64 = 0.85;

/// Converts the robot to a biped; notes where its tree, axes, masses or ranges do not fit a mechanism.
pub(super) fn straight_biped(
    robot: &Robot,
    map: &JointMap,
    poses: &LinkPoses,
    errors: &mut FileErrors,
) -> Option<StraightBiped> {
    let lumps = lumps(robot, map, poses);
    let reached = from_right_foot(map, poses, &lumps)?;
    let mut hinges = PerJoint([Hinge::default(); Joint::COUNT]);
    let mut changes = Vec::new();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let below = Joint::ALL[joint.index() - 1];
        let wrong = match &reached[joint] {
            None => Some("must be connected to the right foot through mapped joints".to_string()),
            Some(Reached { parent, .. }) if joint.is_in_leg() && *parent != below => Some(format!(
                "must be mounted on {}, next to {}: from foot to foot the joints are ankle roll, ankle pitch, knee, \
                 hip \
                 pitch, hip yaw, hip roll, and the same down again; here it is next to {}",
                carried(below),
                below.name(),
                parent.name()
            )),
            Some(Reached { parent, .. }) if *parent >= joint => {
                Some(format!("must come before {} on the way from the pelvis", parent.name()))
            }
            Some(_) => None,
        };
        if let Some(wrong) = wrong {
            errors.note(format!("joint {} as {}: {wrong}", urdf_name(robot, map, joint), joint.name()));
        } else if let Some(reached) = &reached[joint] {
            hinges[joint] = hinge(robot, map, poses, joint, reached, errors, &mut changes)?;
        }
    }

    let mut bodies = PerJoint([LumpedBody::default(); Joint::COUNT]);
    for (link, lump) in robot.links.iter().zip(&lumps) {
        let mass = link.inertial.mass.value;
        if !(mass >= 0.0 && mass.is_finite()) {
            errors.note(format!("link {}: mass = {mass}: must be at least 0", link.name));
        }
        let carrier = Joint::ALL.into_iter().find(|joint| match &reached[*joint] {
            Some(reached) => reached.lump == *lump,
            None => false,
        });
        if let Some(carrier) = carrier {
            let place = robot.links.iter().position(|other| other.name == link.name)?;
            bodies[carrier] = bodies[carrier].with(&LumpedBody::of_link(&link.inertial, &poses.link_to_root[place]));
        }
    }
    for joint in Joint::ALL {
        if joint.link_name().is_some() && reached[joint].is_some() && bodies[joint].mass == 0.0 {
            errors.note(format!("{} weighs nothing: its links must have mass", carried(joint)));
        }
    }
    Some(StraightBiped { hinges, bodies, changes })
}

/// A joint as reached from the right foot.
#[derive(Clone, Copy, Debug)]
struct Reached {
    parent: Joint,
    /// Index of the combined link that it carries.
    lump: usize,
    /// Whether it carries the link that is its parent in the URDF.
    reversed: bool,
}

/// Index of the first link that is rigidly connected, for each link of the URDF.
fn lumps(robot: &Robot, map: &JointMap, poses: &LinkPoses) -> Vec<usize> {
    let mut lumps: Vec<usize> = (0..robot.links.len()).collect();
    for (index, [parent, child]) in poses.ends.iter().enumerate() {
        if map.joints.0.iter().flatten().all(|mapped| mapped.index != index) {
            let (from, to) = (lumps[*child].max(lumps[*parent]), lumps[*child].min(lumps[*parent]));
            lumps.iter_mut().filter(|lump| **lump == from).for_each(|lump| *lump = to);
        }
    }
    lumps
}

/// Traverses the tree from the right foot, which is the link at the right ankle's roll joint that is not at its pitch
/// joint.
fn from_right_foot(map: &JointMap, poses: &LinkPoses, lumps: &[usize]) -> Option<PerJoint<Option<Reached>>> {
    let sides = |joint: Joint| map.joints[joint].map(|mapped| poses.ends[mapped.index].map(|link| lumps[link]));
    let (roll, pitch) = (sides(Joint::RightAnkleRoll)?, sides(Joint::RightAnklePitch)?);
    let foot = if pitch.contains(&roll[0]) { roll[1] } else { roll[0] };
    let mut reached = PerJoint([None; Joint::COUNT]);
    reached[Joint::FootPitch] = Some(Reached { parent: Joint::FootRoll, lump: foot, reversed: false });
    for _ in Joint::ALL {
        for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
            let Some([urdf_parent, urdf_child]) = sides(joint) else { continue };
            if reached[joint].is_some() {
                continue;
            }
            let carrier = |lump: usize| {
                Joint::ALL.into_iter().find(|other| reached[*other].is_some_and(|other: Reached| other.lump == lump))
            };
            reached[joint] = match (carrier(urdf_parent), carrier(urdf_child)) {
                (Some(parent), None) => Some(Reached { parent, lump: urdf_child, reversed: false }),
                (None, Some(parent)) => Some(Reached { parent, lump: urdf_parent, reversed: true }),
                _ => None,
            };
        }
    }
    Some(reached)
}

fn hinge(
    robot: &Robot,
    map: &JointMap,
    poses: &LinkPoses,
    joint: Joint,
    reached: &Reached,
    errors: &mut FileErrors,
    changes: &mut Vec<String>,
) -> Option<Hinge> {
    let mapped = map.joints[joint]?;
    let urdf = &robot.joints[mapped.index];
    let name = format!("joint {} as {}", urdf.name, joint.name());
    let (place, axis) = poses.joints[mapped.index];
    let (axis, turned) = upright(axis, wanted_axes(joint));
    if !wanted_axes(joint).is_empty() && !wanted_axes(joint).contains(&axis.into_inner()) {
        let wanted: Vec<&str> = wanted_axes(joint).iter().map(|axis| axis_name(axis)).collect();
        errors.note(format!(
            "{name}: its axis, standing straight, is [{:.4}, {:.4}, {:.4}]; it must lie along {} (x forward, y left, \
             z up)",
            axis.x,
            axis.y,
            axis.z,
            wanted.join(" or ")
        ));
    }

    let range = match (mapped.range, &urdf.joint_type) {
        (Some(range), _) => range,
        (None, JointType::Revolute) => [urdf.limit.lower, urdf.limit.upper],
        (None, _) => [0.0; 2],
    };
    if !(range[0] <= mapped.straight && mapped.straight <= range[1] && range[0] < range[1]) {
        let [lower, upper, straight] = [range[0], range[1], mapped.straight].map(f64::to_degrees);
        errors.note(format!(
            "{name}: its range is {lower:.2}° to {upper:.2}°; it must have {straight:.2}° inside, where it stands \
             straight: \
             give range_deg in the map"
        ));
    }
    let range = range.map(|angle| angle - mapped.straight);
    let range = if reached.reversed ^ turned { [-range[1], -range[0]] } else { range };

    let motor = &map.motors[mapped.motor];
    let usable =
        motor.1.dc().map_or(f64::INFINITY, |dc| NO_LOAD_SHARE * dc.voltage_max / (dc.torque_constant * dc.gear_ratio));
    let told = if urdf.limit.velocity > 0.0 { urdf.limit.velocity } else { f64::INFINITY };
    let rate_max = mapped.rate_max.unwrap_or_else(|| {
        if told > usable {
            changes.push(format!(
                "{}: rate limited to {:.0} °/s, {:.0} % of what motor {} does without load (URDF: {:.0} °/s)",
                joint.name(),
                usable.to_degrees(),
                NO_LOAD_SHARE * 100.0,
                motor.0,
                told.to_degrees()
            ));
        }
        told.min(usable)
    });
    Some(Hinge { parent: reached.parent, place, axis, range, rate_max })
}

/// An axis with its greatest component positive, set exactly to the direction that it should have; and whether it was
/// reversed.
fn upright(axis: Unit<Vector3<f64>>, wanted: &[Vector3<f64>]) -> (Unit<Vector3<f64>>, bool) {
    let turned = axis[axis.iamax()] < 0.0;
    let axis = if turned { -axis } else { axis };
    let all = [Vector3::x(), Vector3::y(), Vector3::z()];
    let near = wanted.iter().chain(&all).find(|wanted| axis.cross(wanted).norm() <= AXIS_OFF);
    (near.map_or(axis, |near| Unit::new_unchecked(*near)), turned)
}

/// The directions that a joint's axis may have; empty for the arms, whose axes must only be symmetric.
fn wanted_axes(joint: Joint) -> &'static [Vector3<f64>] {
    use Joint::*;
    const X: Vector3<f64> = Vector3::new(1.0, 0.0, 0.0);
    const Y: Vector3<f64> = Vector3::new(0.0, 1.0, 0.0);
    const Z: Vector3<f64> = Vector3::new(0.0, 0.0, 1.0);
    match joint {
        FootRoll | RightAnkleRoll | LeftAnkleRoll | RightHipRoll | LeftHipRoll => &[X],
        RightHipYaw | LeftHipYaw => &[Z],
        WaistPitch | WaistRoll => &[X, Y],
        RightShoulder | RightElbow | LeftShoulder | LeftElbow => &[],
        _ => &[Y],
    }
}

fn axis_name(axis: &Vector3<f64>) -> &'static str {
    ["x", "y", "z"][axis.iamax()]
}

fn urdf_name<'r>(robot: &'r Robot, map: &JointMap, joint: Joint) -> &'r str {
    map.joints[joint].map_or("", |mapped| robot.joints[mapped.index].name.as_str())
}
