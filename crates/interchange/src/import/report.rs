//! Lines for users: which joint does what, what is held, and what looks odd.

use model::Side;

use crate::import::arm::Arm;
use crate::import::biped::Biped;
use crate::import::body::LumpedBody;
use crate::import::import_map::ImportMap;
use crate::import::role::JointRole;
use crate::import::urdf_robot::{JointKind, UrdfRobot};
use crate::import::waist::Waist;
use crate::side_name::side_name;

/// Tells the roles of the joints; `legs` are those of right and left leg from the pelvis down.
pub(super) fn roles(
    robot: &UrdfRobot,
    used: &[(JointRole, usize)],
    legs: [[usize; 6]; 2],
    waist: &Waist,
    lines: &mut Vec<String>,
) {
    for (side, leg) in Side::BOTH.into_iter().zip(legs) {
        let role = |joint: &usize| {
            used.iter().find_map(|(role, own)| match role {
                JointRole::Leg(_, role) if own == joint => Some(role.name().replace('_', " ")),
                _ => None,
            })
        };
        let words = leg.iter().filter_map(|joint| Some(format!("{} {}", role(joint)?, robot.joints[*joint].name)));
        let words: Vec<String> = words.collect();
        lines.push(format!("{} leg, from the pelvis down: {}", side_name(side), words.join(", ")));
    }
    let of_waist = used.iter().filter(|(role, _)| matches!(role, JointRole::WaistPitch | JointRole::WaistRoll));
    let of_waist: Vec<String> =
        of_waist.map(|(role, joint)| format!("{} {}", role.name(), robot.joints[*joint].name)).collect();
    let names: Vec<&str> = waist.joints.iter().map(|(joint, _)| robot.joints[*joint].name.as_str()).collect();
    lines.push(match (of_waist.is_empty(), names.is_empty()) {
        (false, _) => format!("waist: {}", of_waist.join(", ")),
        (true, true) => "waist: none, the legs hang on the trunk".to_string(),
        (true, false) => format!("waist: held ({}), it does not both pitch and roll", names.join(", ")),
    });
}

/// Tells which joints swing and bend the arms, and which others are turned for that; or why arms are held.
pub(super) fn arms(robot: &UrdfRobot, arms: &Result<[Arm; 2], String>, lines: &mut Vec<String>) {
    let arms = match arms {
        Ok(arms) => arms,
        Err(why) => return lines.push(format!("arms: held; {why}")),
    };
    let name = |joint: usize| robot.joints[joint].name.as_str();
    for (side, arm) in Side::BOTH.into_iter().zip(arms) {
        let mut text = format!("{} arm: shoulder {}", side_name(side), name(arm.shoulder.0));
        text += &arm.elbow.map_or(", no elbow".to_string(), |(elbow, _)| format!(", elbow {}", name(elbow)));
        for (place, (joint, angle)) in arm.held.iter().enumerate() {
            let before = if place == 0 { "; it hangs with" } else { " and" };
            text += &format!("{before} {} at {:.0}°", name(*joint), angle.to_degrees());
        }
        lines.push(text);
    }
}

/// Tells what is held, at which angles; what slides or floats; and which couplings are left out.
pub(super) fn held(
    robot: &UrdfRobot,
    map: &ImportMap,
    held: &[(usize, f64)],
    used: &[(JointRole, usize)],
    lines: &mut Vec<String>,
) {
    let name = |joint: usize| robot.joints[joint].name.as_str();
    let at_zero: Vec<&str> = held.iter().filter(|(_, angle)| *angle == 0.0).map(|(joint, _)| name(*joint)).collect();
    let elsewhere: Vec<String> = held
        .iter()
        .filter(|(_, angle)| *angle != 0.0)
        .map(|(joint, angle)| format!("{} at {:.2}°", name(*joint), angle.to_degrees()))
        .collect();
    if !at_zero.is_empty() {
        lines.push(format!("held at 0°: {}", at_zero.join(", ")));
    }
    if !elsewhere.is_empty() {
        lines.push(format!("held: {}", elsewhere.join(", ")));
    }
    for (index, joint) in robot.joints.iter().enumerate() {
        let at_root = joint.parent == robot.root && robot.links[robot.root].body.mass == 0.0;
        let floats = joint.kind == JointKind::Floating && at_root;
        if matches!(joint.kind, JointKind::Prismatic | JointKind::Planar | JointKind::Floating) && !floats {
            lines.push(format!("held: {}, a {} joint", joint.name, joint.kind.name()));
        }
        let limit = joint.limit;
        if joint.kind == JointKind::Revolute && limit.lower > limit.upper && used.iter().all(|(_, own)| *own != index) {
            let told = format!("lower {} > upper {}", limit.lower, limit.upper);
            lines.push(format!(
                "{}: its limits contradict each other ({told}); it is held, so they do not matter",
                joint.name
            ));
        }
    }
    couplings(robot, used, lines);
    let is_used = |role: JointRole| used.iter().any(|(own, _)| *own == role);
    let are_arms_held = !used.iter().any(|(role, _)| role.is_in_arm());
    for (role, joint) in map.joints.iter().filter(|(role, _)| !is_used(*role)) {
        let which = joint.urdf.map_or(String::new(), |joint| format!(" ({})", name(joint)));
        let why = if role.is_in_arm() && are_arms_held { "arms are held" } else { "the robot has no such joint" };
        lines.push(format!("joint.{}{which} of the map is not used: {why}", role.name()));
    }
}

/// Tells which held joints mimic others: the couplings are left out.
fn couplings(robot: &UrdfRobot, used: &[(JointRole, usize)], lines: &mut Vec<String>) {
    let is_used = |name: &str| used.iter().any(|(_, joint)| robot.joints[*joint].name == name);
    let mut told: Vec<(&str, Vec<&str>)> = Vec::new();
    for joint in robot.joints.iter().filter(|joint| !is_used(&joint.name)) {
        let Some(mimic) = &joint.mimic else { continue };
        match told.iter_mut().find(|(other, _)| *other == mimic.joint) {
            Some((_, joints)) => joints.push(&joint.name),
            None => told.push((&mimic.joint, vec![&joint.name])),
        }
    }
    for (other, joints) in told {
        let moves = if is_used(other) { ", which moves," } else { "" };
        lines.push(format!("couplings to {other}{moves} are not taken over (mimic): {} held", joints.join(", ")));
    }
}

/// All bodies of a biped with their names.
pub(super) fn bodies(biped: &Biped) -> Vec<(&'static str, LumpedBody)> {
    let mut bodies = vec![("the pelvis", biped.pelvis), ("the waist", biped.middle), ("the trunk", biped.trunk)];
    for (side, leg) in biped.legs.iter().enumerate() {
        let names = [
            ["the right hip", "the left hip"],
            ["the right hip", "the left hip"],
            ["the right thigh", "the left thigh"],
            ["the right shank", "the left shank"],
            ["the right ankle", "the left ankle"],
            ["the right foot", "the left foot"],
        ];
        bodies.extend(leg.iter().zip(names).map(|(segment, names)| (names[side], segment.body)));
        let names = [["the right upper arm", "the left upper arm"], ["the right forearm", "the left forearm"]];
        let arm = biped.arms[side].iter().zip(names);
        bodies.extend(arm.map(|(segment, names)| (names[side], segment.body)));
    }
    bodies
}
