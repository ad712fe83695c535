//! The held joints of a floating robot: small trees of links between or beyond those of the mechanism.

use std::ops::Range;

use heapless::Vec;
use model::{Body, HeldLink, Joint, PerJoint, UnlumpedMechanism};
use nalgebra::{Matrix3, Vector3};

use crate::joint_axis::JointAxis;

/// The held joints of a tree, in the order of [`UnlumpedMechanism::held`].
#[derive(Clone, Debug)]
pub(crate) struct HeldTree {
    pub nodes: std::vec::Vec<HeldNode>,
    /// The held joints on each link.
    on_link: PerJoint<Range<usize>>,
    /// The held joint that carries a joint of the mechanism, and the joint's position in the frame of that (m).
    pub below: PerJoint<Option<(usize, Vector3<f64>)>>,
}

/// One held joint and its link.
#[derive(Clone, Debug)]
pub(crate) struct HeldNode {
    /// The held joint that carries it; `None` for the link that it is on.
    pub below: Option<usize>,
    pub axis: JointAxis,
    /// Position of the joint in the frame of what carries it (m).
    pub origin: Vector3<f64>,
    /// Mass and inertia of the link; `None` for a massless link.
    pub body: Option<Body>,
}

/// Pose of a held link, in the axes and from the origin of the [`Kinematics`](crate::Kinematics) that it belongs to.
#[derive(Clone, Copy, Debug)]
pub struct HeldPose {
    /// Orientation of the link, a rotation matrix (-): maps link coordinates to world axes.
    pub rotation: Matrix3<f64>,
    /// Position of the link's origin, on its joint (m).
    pub origin: Vector3<f64>,
    /// Axis of the joint, a unit vector in world axes.
    pub axis: Vector3<f64>,
}

/// Poses of all held links.
pub type HeldPoses = Vec<HeldPose, { HeldLink::COUNT_MAX }>;

impl HeldTree {
    /// The held joints of a robot; `None` for one without any.
    pub(crate) fn new(robot: &UnlumpedMechanism) -> Option<Box<Self>> {
        let held = &robot.held;
        if held.is_empty() {
            return None;
        }
        let nodes = held.iter().map(|link| HeldNode {
            below: link.below,
            axis: JointAxis::new(link.axis),
            origin: link.origin,
            body: (link.body.mass > 0.0).then_some(link.body),
        });
        let on_link = PerJoint::from_fn(|joint| {
            let first = held.iter().position(|link| link.mount == joint).unwrap_or_default();
            first..first + held.iter().filter(|link| link.mount == joint).count()
        });
        let below = PerJoint::from_fn(|joint| {
            let carrier = held.iter().position(|link| link.carries.contains(&joint))?;
            let mut place = robot.mechanism.links[joint].origin;
            let mut next = Some(carrier);
            while let Some(index) = next {
                place -= held[index].origin;
                next = held[index].below;
            }
            Some((carrier, place))
        });
        Some(Box::new(Self { nodes: nodes.collect(), on_link, below }))
    }

    /// The held joints on a link, each after the one that carries it.
    #[inline]
    pub(crate) fn on(&self, link: Joint) -> Range<usize> {
        self.on_link[link].clone()
    }
}
