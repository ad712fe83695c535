//! The chains of joints that leave the trunk to its right and left: arms, if they have joints that swing them.

use crate::import::body_graph::BodyGraph;
use crate::import::posture::Poses;
use crate::import::urdf_robot::UrdfRobot;

/// How far beside the middle an arm has its centre of mass at least, in leg lengths.
const ASIDE: f64 = 0.1;

/// The joints of an arm from the trunk outward, each with the body behind it.
pub(super) type ArmChain = Vec<(usize, usize)>;

/// The right and the left arm: of the trunk's branches to either side the heaviest, and at each of its forks the
/// heaviest branch; the first in the URDF of those that weigh the same.
///
/// * `trunk` – the body from which the arms branch off
/// * `closed` – joints of legs and waist, which lead elsewhere
/// * `poses` – of the standing robot
/// * `leg` – length of the leg (m)
pub(super) fn find(
    robot: &UrdfRobot,
    graph: &BodyGraph,
    trunk: usize,
    closed: &[usize],
    poses: &Poses,
    leg: f64,
) -> [Option<ArmChain>; 2] {
    let branches = branches(robot, graph, trunk, closed);
    [-1.0, 1.0].map(|side| {
        let is_there = |branch: &&Branch| {
            let body = graph.lump(robot, poses, &graph.beyond(branch.body, &[branch.joint]));
            body.mass > 0.0 && body.com.y * side > ASIDE * leg
        };
        branches.iter().find(is_there).map(|branch| chain(robot, graph, branch))
    })
}

/// What hangs on a joint of a body.
struct Branch {
    joint: usize,
    body: usize,
    /// Mass of all that hangs on it (kg).
    mass: f64,
}

/// The branches of a body, the heaviest first.
fn branches(robot: &UrdfRobot, graph: &BodyGraph, body: usize, closed: &[usize]) -> Vec<Branch> {
    let open = graph.neighbours[body].iter().filter(|(joint, _)| !closed.contains(joint));
    let mut branches: Vec<Branch> = open
        .map(|&(joint, body)| Branch { joint, body, mass: graph.mass(robot, &graph.beyond(body, &[joint])) })
        .collect();
    branches.sort_by(|one, other| other.mass.total_cmp(&one.mass));
    branches
}

fn chain(robot: &UrdfRobot, graph: &BodyGraph, first: &Branch) -> ArmChain {
    let mut chain = vec![(first.joint, first.body)];
    let mut end = chain[0];
    while let Some(next) = branches(robot, graph, end.1, &[end.0]).first() {
        end = (next.joint, next.body);
        chain.push(end);
    }
    chain
}
