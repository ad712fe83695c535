//! The mechanism prepared for the algorithms: axes sorted by direction, massless links and coincident origins marked.

use model::{Joint, JointOrder, Mechanism, PerJoint, Side, UnlumpedMechanism};
use nalgebra::Vector3;

use crate::held_tree::HeldTree;
use crate::joint_axis::JointAxis;

/// A mechanism prepared for the algorithms. Read-only.
#[derive(Clone, Debug)]
pub struct Tree {
    pub(crate) nodes: PerJoint<Node>,
    /// All joints, parents before their children.
    pub(crate) order: JointOrder,
    /// Mass of the whole robot (kg).
    pub mass: f64,
    /// The held joints that turn; `None` for a robot that has none, or that is taken as rigid there.
    pub(crate) held: Option<Box<HeldTree>>,
}

/// One joint and its link.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// The joint that carries the parent link; `None` for the ground.
    pub parent: Option<Joint>,
    /// Axis of the joint.
    pub axis: JointAxis,
    /// Position of the joint in the parent's frame (m); `None` where the two joints coincide.
    pub origin: Option<Vector3<f64>>,
    /// Mass and inertia of the link; `None` for a massless link.
    pub body: Option<model::Body>,
    /// Whether it never moves: the robot does not have the joint.
    pub is_rigid: bool,
}

impl Tree {
    /// The tree of a mechanism, held joints rigid.
    pub fn new(mechanism: &Mechanism) -> Self {
        let nodes = PerJoint::from_fn(|joint| {
            let link = &mechanism.links[joint];
            Node {
                parent: link.parent,
                axis: JointAxis::new(link.axis),
                origin: (link.origin != Vector3::zeros()).then_some(link.origin),
                body: (link.body.mass > 0.0).then_some(link.body),
                is_rigid: joint.is_powered() && !mechanism.has(joint),
            }
        });
        Self { nodes, order: mechanism.order, mass: mechanism.mass(), held: None }
    }

    /// The tree of a robot whose held joints turn; its links are without the bodies of held ones.
    pub fn with_held(robot: &UnlumpedMechanism) -> Self {
        let held = HeldTree::new(robot);
        let of_held: f64 = robot.held.iter().map(|link| link.body.mass).sum();
        let tree = Self::new(&robot.mechanism);
        if held.is_none() { tree } else { Self { mass: tree.mass + of_held, held, ..tree } }
    }

    /// Number of held joints that turn.
    pub fn held_count(&self) -> usize {
        self.held.as_ref().map_or(0, |held| held.nodes.len())
    }

    /// The held joint that carries a joint, by its index; `None` if its parent link does.
    pub fn held_below(&self, joint: Joint) -> Option<usize> {
        self.held.as_ref().and_then(|held| held.below[joint]).map(|(index, _)| index)
    }

    /// The held joint that carries another held one; `None` if a link of the mechanism does.
    pub fn held_below_held(&self, index: usize) -> Option<usize> {
        self.held.as_ref().and_then(|held| held.nodes.get(index)?.below)
    }

    /// The joints of the floating robot, whose base is the right foot: all but the two on the ground.
    #[inline(always)]
    pub(crate) fn floating_joints(&self) -> impl DoubleEndedIterator<Item = Joint> {
        self.order.all()[Joint::FIRST_POWERED.index()..].iter().copied()
    }

    /// The joint whose link is the pelvis.
    #[inline(always)]
    pub fn pelvis(&self) -> Joint {
        self.order.pelvis()
    }

    /// The joint whose link is the foot on `side`.
    #[inline(always)]
    pub fn foot(&self, side: Side) -> Joint {
        self.order.foot(side)
    }

    /// The six joints of a leg: from the ankle up for the right one, from the hip down for the left one.
    #[inline(always)]
    pub fn leg(&self, side: Side) -> [Joint; 6] {
        self.order.leg(side)
    }
}
