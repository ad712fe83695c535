//! Finds the two legs: the ways from the two lowest ends of the robot to the body where they meet.

use crate::import::body_graph::BodyGraph;
use crate::import::file_errors::FileErrors;
use crate::import::import_map::ImportMap;
use crate::import::posture::Poses;
use crate::import::role::JointRole;
use crate::import::urdf_robot::UrdfRobot;
use crate::import::urdf_tree::listed;

/// How far two feet may differ in height, as a share of the robot's (the joints') height.
const LEVEL: f64 = 0.05;

/// Two legs. No side yet.
#[derive(Clone, Debug)]
pub(super) struct LegPair {
    /// Joints of each leg by index, from the pelvis down.
    pub joints: [[usize; 6]; 2],
    /// The body below each of these joints; the last is the foot.
    pub bodies: [[usize; 6]; 2],
    /// The body where the legs meet.
    pub pelvis: usize,
}

impl LegPair {
    /// The same legs in the graph in which the upper body's held joints turn, too: what is held there is no less a
    /// waist's joint.
    pub(super) fn with_upper_body(&self, robot: &UrdfRobot, graph: &BodyGraph) -> (BodyGraph, LegPair) {
        let all = BodyGraph::new(robot, |joint| robot.joints[joint].turns());
        let ends = |graph: &BodyGraph| [0, 1].map(|leg| graph.body_of[self.bodies[leg][5]]);
        let [start, end] = ends(&all);
        let between = all.path(start, end);
        let upper = graph.beyond(self.pelvis, &[self.joints[0][0], self.joints[1][0]]);
        let full = BodyGraph::new(robot, |index| {
            let joint = &robot.joints[index];
            let is_upper = upper.contains(&graph.body_of[joint.parent]) && between.iter().all(|(own, _)| *own != index);
            joint.turns() && (graph.joints.contains(&index) || is_upper)
        });
        let [start, end] = ends(&full);
        let path = full.path(start, end);
        if path.len() == 12 { (full, LegPair::of_path(start, &path)) } else { (graph.clone(), self.clone()) }
    }

    /// The legs of a way of twelve joints from foot to foot that begins at a body.
    fn of_path(start: usize, path: &[(usize, usize)]) -> Self {
        let mut bodies: Vec<usize> = vec![start];
        bodies.extend(path.iter().map(|(_, body)| *body));
        let up = std::array::from_fn(|place| path[5 - place].0);
        let down = std::array::from_fn(|place| path[6 + place].0);
        Self {
            joints: [up, down],
            bodies: [std::array::from_fn(|place| bodies[5 - place]), std::array::from_fn(|place| bodies[7 + place])],
            pelvis: bodies[6],
        }
    }
}

/// Finds the legs; notes what was found instead. `poses` is the zero posture in the root link's frame, z up.
pub(super) fn find(
    robot: &UrdfRobot,
    map: &ImportMap,
    graph: &BodyGraph,
    poses: &Poses,
    errors: &mut FileErrors,
) -> Option<LegPair> {
    let mapped: Vec<(JointRole, usize)> = map
        .joints
        .iter()
        .filter(|(role, _)| matches!(role, JointRole::Leg(..)))
        .filter_map(|(role, joint)| Some((*role, joint.urdf?)))
        .collect();
    let height = |joint: usize| poses.joints[joint].0.z;
    let mut ends: Vec<(usize, f64)> =
        graph.ends().into_iter().map(|body| (body, height(graph.neighbours[body][0].0))).collect();
    ends.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let highest = graph.joints.iter().map(|joint| height(*joint)).fold(f64::NEG_INFINITY, f64::max);

    let mut best: Option<PathBetweenEnds> = None;
    for (rank, (end, z)) in ends.iter().enumerate() {
        let level = LEVEL * (highest - z) + 1e-3;
        // Feet are the lowest; where the map names the legs, others are tried as well.
        let is_lowest = z - ends[0].1 <= level;
        for (other, other_z) in &ends[rank + 1..] {
            if other_z - z > level || (!is_lowest && mapped.is_empty()) {
                break;
            }
            let path = graph.path(*other, *end);
            if mapped.iter().any(|(_, joint)| path.iter().all(|(own, _)| own != joint)) {
                continue;
            }
            let off = asymmetry(&path, poses);
            let better = best
                .as_ref()
                .is_none_or(|best| path.len() > best.path.len() || (path.len() == best.path.len() && off < best.off));
            if better {
                best = Some(PathBetweenEnds { path, start: *other, off });
            }
        }
        if best.is_some() {
            break;
        }
    }
    let Some(PathBetweenEnds { path, start, .. }) = best else {
        errors.note(no_legs(robot, &ends, &mapped));
        return None;
    };
    if path.len() != 12 {
        errors.note(wrong_number(robot, poses, &path));
        return None;
    }
    Some(LegPair::of_path(start, &path))
}

/// A path between two ends of the robot.
struct PathBetweenEnds {
    /// Its joints, each with the body behind it.
    path: Vec<(usize, usize)>,
    /// The body where it begins.
    start: usize,
    /// How little its halves are alike (m).
    off: f64,
}

/// How little the joints of one half of a path are the mirror image of the other half, in any upright plane (m).
fn asymmetry(path: &[(usize, usize)], poses: &Poses) -> f64 {
    let place = |index: usize| poses.joints[path[index].0].0;
    (0..path.len() / 2).map(|index| (place(index).z - place(path.len() - 1 - index).z).abs()).sum()
}

fn no_legs(robot: &UrdfRobot, ends: &[(usize, f64)], mapped: &[(JointRole, usize)]) -> String {
    if ends.is_empty() {
        return "must have joints that turn (revolute or continuous): none was found".to_string();
    }
    if !mapped.is_empty() {
        let names = listed(mapped.iter().map(|(_, joint)| robot.joints[*joint].name.as_str()));
        return format!("must have two legs, from foot to foot over the map's joints {names}: no such way was found");
    }
    let names = listed(ends.iter().map(|(body, _)| robot.links[*body].name.as_str()).take(4));
    format!(
        "must have two legs that end at the same height, lowest of all, with z up: its lowest ends, the lowest first, \
         are {names}"
    )
}

fn wrong_number(robot: &UrdfRobot, poses: &Poses, path: &[(usize, usize)]) -> String {
    let told = |(joint, _): &(usize, usize)| {
        let axis = poses.joints[*joint].1;
        format!("{} (about {})", robot.joints[*joint].name, ["x", "y", "z"][axis.iamax()])
    };
    let half = path.len() / 2;
    let one = path[..half].iter().rev().map(told).collect::<Vec<_>>().join(", ");
    let other = path[half..].iter().map(told).collect::<Vec<_>>().join(", ");
    let count = if path.len().is_multiple_of(2) {
        format!("{half} joints in each leg")
    } else {
        format!("{} joints from foot to foot", path.len())
    };
    format!(
        "a leg must have exactly six joints that turn, from the pelvis down: three of the hip, a knee, two of the \
         ankle; found {count}: {one}; and {other}. A joint that shall not move, such as a toe's, may be held: \
         [[held]] in the map"
    )
}
