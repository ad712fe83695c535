//! The robot as rigid bodies, each one or several links of the URDF, and the joints that turn between them. The tree is
//! read without direction: a URDF may be rooted at any link.

use crate::import::body::LumpedBody;
use crate::import::posture::Poses;
use crate::import::urdf_robot::UrdfRobot;

/// Bodies and the joints between them.
#[derive(Clone, Debug)]
pub(super) struct BodyGraph {
    /// The body of each link of the URDF.
    pub body_of: Vec<usize>,
    /// The joints that turn, by index in the URDF.
    pub joints: Vec<usize>,
    /// For each body, its joints and the body at the other end of each.
    pub neighbours: Vec<Vec<(usize, usize)>>,
}

impl BodyGraph {
    /// The bodies of a robot of which the joints that `turns` names can turn.
    pub(super) fn new(robot: &UrdfRobot, turns: impl Fn(usize) -> bool) -> Self {
        let mut body_of: Vec<usize> = (0..robot.links.len()).collect();
        let joints: Vec<usize> = (0..robot.joints.len()).filter(|joint| turns(*joint)).collect();
        for (index, joint) in robot.joints.iter().enumerate() {
            if !turns(index) {
                let (from, to) = (body_of[joint.child], body_of[joint.parent]);
                body_of.iter_mut().filter(|body| **body == from).for_each(|body| *body = to);
            }
        }
        let mut neighbours = vec![Vec::new(); robot.links.len()];
        for &index in &joints {
            let joint = &robot.joints[index];
            let (parent, child) = (body_of[joint.parent], body_of[joint.child]);
            neighbours[parent].push((index, child));
            neighbours[child].push((index, parent));
        }
        Self { body_of, joints, neighbours }
    }

    /// Bodies with a single joint.
    pub(super) fn ends(&self) -> Vec<usize> {
        (0..self.neighbours.len()).filter(|body| self.neighbours[*body].len() == 1).collect()
    }

    /// The joints on the way from one body to another, each with the body behind it.
    pub(super) fn path(&self, from: usize, to: usize) -> Vec<(usize, usize)> {
        let mut came_by: Vec<Option<(usize, usize)>> = vec![None; self.neighbours.len()];
        let mut open = vec![from];
        while let Some(body) = open.pop() {
            for &(joint, next) in &self.neighbours[body] {
                if next != from && came_by[next].is_none() {
                    came_by[next] = Some((joint, body));
                    open.push(next);
                }
            }
        }
        let mut path = Vec::new();
        let mut body = to;
        while let Some((joint, before)) = came_by[body] {
            path.push((joint, body));
            body = before;
        }
        path.reverse();
        path
    }

    /// The bodies that hang on `from`, itself included, without passing any of the joints in `closed`.
    pub(super) fn beyond(&self, from: usize, closed: &[usize]) -> Vec<usize> {
        let mut found = vec![from];
        let mut open = vec![from];
        while let Some(body) = open.pop() {
            for &(joint, next) in &self.neighbours[body] {
                if !closed.contains(&joint) && !found.contains(&next) {
                    found.push(next);
                    open.push(next);
                }
            }
        }
        found
    }

    /// The links of some bodies as one rigid body, in the frame of the poses.
    pub(super) fn lump(&self, robot: &UrdfRobot, poses: &Poses, bodies: &[usize]) -> LumpedBody {
        let links = robot.links.iter().zip(&poses.links).zip(&self.body_of);
        let own = links.filter(|(_, body)| bodies.contains(body));
        own.fold(LumpedBody::default(), |sum, ((link, pose), _)| sum.with(&link.body.moved(pose)))
    }

    /// Mass of some bodies (kg).
    pub(super) fn mass(&self, robot: &UrdfRobot, bodies: &[usize]) -> f64 {
        let links = robot.links.iter().zip(&self.body_of);
        links.filter(|(_, body)| bodies.contains(body)).map(|(link, _)| link.body.mass).sum()
    }
}
