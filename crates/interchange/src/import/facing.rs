//! Finds out where the robot faces and which leg is the right one, whatever its root link's frame says.
//!
//! The legs tell the lateral direction. Which end of it is left follows from where the knees bend, the feet's shapes
//! and masses, and, if these say nothing, from names.

use model::Side;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::import::file_errors::FileErrors;
use crate::import::import_map::ImportMap;
use crate::import::leg_pair::LegPair;
use crate::import::posture::Poses;
use crate::import::role::JointRole;
use crate::import::sole::contact_points;
use crate::import::urdf_robot::{JointKind, UrdfRobot};

/// How far from the root frame's axis the lateral direction counts as along it (rad): sides differ a little.
const SNAP: f64 = 0.0175;
/// Difference of bending to both sides from which knees tell a direction (rad).
const KNEE_DIFFERENCE: f64 = 0.35;

/// Sum of weights from which a direction is no mere assumption.
const SURE: f64 = 0.5;
/// How far from the ankle a frame on the foot marks heel or toe (m).
const MARK: f64 = 0.01;

/// Direction and sides of a robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facing {
    /// Maps the root link's coordinates to those of the standing robot: x ahead, y left, z up, y = 0 in the middle.
    pub root_to_stand: Isometry3<f64>,
    /// Which of the two legs is the right one.
    pub right: usize,
}

/// A hint at the direction: its weight, positive if the direction tried is right, and its words.
struct Vote(f64, &'static str);

/// Finds the direction, and prints what told it. `poses` is the zero posture in the root link's frame.
pub(super) fn find(
    robot: &UrdfRobot,
    map: &ImportMap,
    legs: &LegPair,
    body_of: &[usize],
    poses: &Poses,
    errors: &mut FileErrors,
    lines: &mut Vec<String>,
) -> Option<Facing> {
    let place = |leg: usize, joint: usize| poses.joints[legs.joints[leg][joint]].0;
    let mut across: Vector3<f64> = (0..6).map(|joint| place(0, joint) - place(1, joint)).sum();
    across.z = 0.0;
    if across.norm() < 6e-3 {
        errors.note("must have legs beside each other: at zero angles one stands in the other");
        return None;
    }
    // From leg 1 to leg 0: the direction tried as left.
    let left = snapped(across.normalize());
    let ahead = left.cross(&Vector3::z());
    let votes = votes(robot, map, legs, body_of, poses, ahead, left);
    let sum: f64 = votes.iter().map(|Vote(weight, _)| weight).sum();
    let (ahead, left, right) = if sum >= 0.0 { (ahead, left, 1) } else { (-ahead, -left, 0) };

    let (with, against): (Vec<&Vote>, Vec<&Vote>) =
        votes.iter().filter(|vote| vote.0 != 0.0).partition(|vote| (vote.0 >= 0.0) == (sum >= 0.0));
    let words = |votes: &[&Vote]| votes.iter().map(|vote| vote.1).collect::<Vec<_>>().join(", ");
    let against = if against.is_empty() { String::new() } else { format!("; against it: {}", words(&against)) };
    let faces = if sum.abs() < SURE { "is assumed to face" } else { "faces" };
    lines.push(format!("{faces} along {} of its root link ({}{against})", direction(ahead), words(&with)));
    if sum.abs() < SURE {
        lines.push("if it faces the other way, name one joint in the map: [joint.right_knee] with urdf = \"…\"".into());
    }

    let turn = Matrix3::from_rows(&[ahead.transpose(), left.transpose(), Vector3::z().transpose()]);
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
    let middle: f64 = (0..6).map(|joint| (place(0, joint) + place(1, joint)).dot(&left)).sum::<f64>() / 12.0;
    let middle = if middle.abs() < 1e-3 { 0.0 } else { middle };
    let root_to_stand = Isometry3::from_parts(Translation3::new(0.0, -middle, 0.0), turn);
    Some(Facing { root_to_stand, right })
}

/// The nearest horizontal axis of the root frame, if it is near.
fn snapped(direction: Vector3<f64>) -> Vector3<f64> {
    let axes = [Vector3::x(), Vector3::y(), -Vector3::x(), -Vector3::y()];
    axes.into_iter().find(|axis| axis.angle(&direction) < SNAP).unwrap_or(direction)
}

fn votes(
    robot: &UrdfRobot,
    map: &ImportMap,
    legs: &LegPair,
    body_of: &[usize],
    poses: &Poses,
    ahead: Vector3<f64>,
    left: Vector3<f64>,
) -> Vec<Vote> {
    let sign = |value: f64, least: f64| if value.abs() > least { value.signum() } else { 0.0 };
    // leg 0 is the left one in the direction tried
    let side_of = |side: Side| if side == Side::Left { 0 } else { 1 };
    let mapped: f64 = map
        .joints
        .iter()
        .filter_map(|(role, joint)| match role {
            JointRole::Leg(side, _) => Some((*side, joint.urdf?)),
            _ => None,
        })
        .map(|(side, urdf)| if legs.joints[side_of(side)].contains(&urdf) { 1.0 } else { -1.0 })
        .sum();

    let bending: f64 = legs
        .joints
        .iter()
        .zip(&legs.bodies)
        .map(|(joints, bodies)| {
            let joint = &robot.joints[joints[3]];
            if joint.kind != JointKind::Revolute || joint.limit.lower > joint.limit.upper {
                return 0.0;
            }
            let below = if body_of[joint.child] == bodies[3] { 1.0 } else { -1.0 };
            (joint.limit.lower + joint.limit.upper) * below * poses.joints[joints[3]].1.dot(&left).signum()
        })
        .sum();

    let (mut soles, mut marks, mut masses) = (0.0, 0.0, 0.0);
    for (joints, bodies) in legs.joints.iter().zip(&legs.bodies) {
        let ankle = poses.joints[joints[4]].0.dot(&ahead);
        let reach = |points: &[Vector3<f64>]| {
            let along: Vec<f64> = points.iter().map(|point| point.dot(&ahead) - ankle).collect();
            let (max, min) = (along.iter().copied().fold(0.0, f64::max), along.iter().copied().fold(0.0, f64::min));
            if max - min > 0.01 { sign((max + min) / (max - min), 0.1) } else { 0.0 }
        };
        soles += reach(&contact_points(robot, body_of, bodies[5], &poses.links));
        let frames = poses.links.iter().zip(body_of).filter(|(_, body)| **body == bodies[5]);
        let frames: Vec<Vector3<f64>> = frames.map(|(pose, _)| pose.translation.vector).collect();
        // Only what marks heel and toe tells where they are.
        let beyond = |sign: f64| frames.iter().any(|place| sign * (place.dot(&ahead) - ankle) > MARK);
        marks += if beyond(1.0) && beyond(-1.0) { reach(&frames) } else { 0.0 };
        let links = robot.links.iter().zip(&poses.links).zip(body_of).filter(|(_, body)| **body == bodies[5]);
        let foot = links.fold(Default::default(), |sum: crate::import::body::LumpedBody, ((link, pose), _)| {
            sum.with(&link.body.moved(pose))
        });
        let shin = (poses.joints[joints[3]].0 - poses.joints[joints[4]].0).norm();
        masses += if foot.mass > 0.0 { sign(foot.com.dot(&ahead) - ankle, 0.02 * shin) } else { 0.0 };
    }
    let named: f64 = [(0, 1.0), (1, -1.0)]
        .into_iter()
        .flat_map(|(leg, is_left)| {
            legs.joints[leg].iter().map(move |joint| is_left * named_left(&robot.joints[*joint].name))
        })
        .sum();
    vec![
        Vote(100.0 * sign(mapped, 0.0), "the map names right and left"),
        Vote(8.0 * sign(bending, KNEE_DIFFERENCE), "the knees bend backward"),
        Vote(3.0 * sign(soles, 0.5), "the soles are longer ahead of the ankles"),
        Vote(1.5 * sign(marks, 0.5), "the feet's parts reach farther ahead of the ankles"),
        Vote(0.6 * sign(masses, 0.5), "the feet weigh more ahead of the ankles"),
        Vote(1.2 * sign(named, 0.5), "names say right and left"),
        Vote(0.1 * sign(ahead.x + 0.5 * ahead.y, 0.0), "x is ahead in URDFs, or else y"),
    ]
}

/// 1 if a name says left, -1 if it says right, else 0.
fn named_left(name: &str) -> f64 {
    let lower = name.to_lowercase();
    let words: Vec<&str> = lower.split(|letter: char| !letter.is_alphabetic()).collect();
    // LHipYaw
    let begins = |capital: char| {
        let mut letters = name.chars();
        letters.next() == Some(capital) && letters.next().is_some_and(char::is_uppercase)
    };
    let says = |long: &str, short: &str, capital| lower.contains(long) || words.contains(&short) || begins(capital);
    match (says("left", "l", 'L'), says("right", "r", 'R')) {
        (true, false) => 1.0,
        (false, true) => -1.0,
        _ => 0.0,
    }
}

/// A horizontal direction in words.
fn direction(direction: Vector3<f64>) -> String {
    let named = [("+x", Vector3::x()), ("+y", Vector3::y()), ("-x", -Vector3::x()), ("-y", -Vector3::y())];
    let named = named.into_iter().find(|(_, axis)| axis.angle(&direction) < 1e-6);
    named.map_or_else(|| format!("[{:.4}, {:.4}, 0]", direction.x, direction.y), |(name, _)| name.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_left_or_right_or_nothing() {
        for (name, left) in [
            ("left_knee", 1.0),
            ("L_HIP_P", 1.0),
            ("J_hipl_l_roll", 1.0),
            ("LHipYawPitch", 1.0),
            ("leg_right_1_joint", -1.0),
            ("R_HIP_R", -1.0),
            ("L_HIP_R", 0.0),
            ("a12", 0.0),
            ("Linkes Knie", 0.0),
        ] {
            assert_eq!(named_left(name), left, "{name}");
        }
    }
}
