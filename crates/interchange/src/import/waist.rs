//! The way from the pelvis to the trunk, and which of its joints tip the trunk.

use crate::import::body_graph::BodyGraph;
use crate::import::file_errors::FileErrors;
use crate::import::import_map::ImportMap;
use crate::import::leg_pair::LegPair;
use crate::import::posture::Poses;
use crate::import::role::JointRole;
use crate::import::urdf_robot::UrdfRobot;

/// Least cosine between a waist joint's axis and y or x.
const ALONG: f64 = 0.85;
/// How much heavier than the next one a branch must be for the way to lead into it.
const FAR_HEAVIER: f64 = 3.0;
/// Least share of the heaviest body's mass that the body has on which the arms branch off.
const TRUNK_SHARE: f64 = 0.2;

/// The way from pelvis to trunk.
#[derive(Clone, Debug, Default)]
pub(super) struct Waist {
    /// Its joints by index, from the pelvis up, each with the body behind it. Empty where the legs hang on the trunk.
    pub joints: Vec<(usize, usize)>,
    /// The joints that pitch and roll the trunk; both or none.
    pub roles: Option<[usize; 2]>,
}

/// Finds the waist; notes joints of the map that are not in it. `poses` are those of the standing robot.
pub(super) fn find(
    robot: &UrdfRobot,
    map: &ImportMap,
    graph: &BodyGraph,
    legs: &LegPair,
    poses: &Poses,
    errors: &mut FileErrors,
) -> Waist {
    let joints = way_to_trunk(robot, graph, legs);
    let told = |role: JointRole| map.joint(role).urdf;
    let pick = |role: JointRole, axis: usize| match told(role) {
        Some(joint) => joints.iter().find(|(own, _)| *own == joint).map(|(own, _)| *own),
        None => {
            let fits = |joint: &&(usize, usize)| {
                poses.joints[joint.0].1[axis].abs() > ALONG && robot.joints[joint.0].mimic.is_none()
            };
            joints.iter().find(fits).map(|(own, _)| *own)
        }
    };
    let (pitch, roll) = (pick(JointRole::WaistPitch, 1), pick(JointRole::WaistRoll, 0));
    for role in [JointRole::WaistPitch, JointRole::WaistRoll] {
        if let Some(joint) = told(role).filter(|joint| joints.iter().all(|(own, _)| own != joint)) {
            let (name, line) = (&robot.joints[joint].name, robot.joints[joint].line);
            errors.note_at(line, format!("joint {name} as {}: must lie between pelvis and trunk", role.name()));
        }
    }
    let roles = pitch.zip(roll).map(|(pitch, roll)| [pitch, roll]).filter(|[pitch, roll]| pitch != roll);
    if roles.is_none()
        && (told(JointRole::WaistPitch).is_some() || told(JointRole::WaistRoll).is_some())
        && errors.is_empty()
    {
        errors.note("a waist must both pitch and roll: leave joint.waist_pitch and joint.waist_roll out of the map");
    }
    Waist { joints, roles }
}

/// Follows the heaviest branch from the pelvis until arms branch off; the trunk is there, unless nearly all mass is
/// nearer.
fn way_to_trunk(robot: &UrdfRobot, graph: &BodyGraph, legs: &LegPair) -> Vec<(usize, usize)> {
    let mut closed: Vec<usize> = legs.joints.iter().map(|leg| leg[0]).collect();
    let mut way = Vec::new();
    let mut body = legs.pelvis;
    let branches_off = loop {
        let mut branches: Vec<(f64, usize, usize)> = graph.neighbours[body]
            .iter()
            .filter(|(joint, _)| !closed.contains(joint))
            .map(|(joint, next)| (graph.mass(robot, &graph.beyond(*next, &[*joint])), *joint, *next))
            .collect();
        branches.sort_by(|a, b| b.0.total_cmp(&a.0));
        let next = match branches.as_slice() {
            [] => break false,
            [only] => only,
            [first, second, ..] if first.0 > FAR_HEAVIER * second.0 => first,
            _ => break true,
        };
        closed.push(next.1);
        way.push((next.1, next.2));
        body = next.2;
    };
    let mass = |body: usize| graph.mass(robot, &[body]);
    let heaviest = way.iter().map(|(_, body)| mass(*body)).fold(mass(legs.pelvis), f64::max);
    if branches_off && mass(body) >= TRUNK_SHARE * heaviest {
        return way;
    }
    let trunk = way.iter().rposition(|(_, body)| mass(*body) >= heaviest);
    way.truncate(trunk.map_or(0, |place| place + 1));
    way
}
