//! The mechanism prepared for the algorithms: axes sorted by direction, massless links and coincident origins marked.

use model::{Joint, JointOrder, Mechanism, PerJoint, Side};
use nalgebra::{Matrix3, Unit, Vector3};

/// A mechanism prepared for the algorithms. Read-only.
#[derive(Clone, Debug)]
pub struct Tree {
    pub(crate) nodes: PerJoint<Node>,
    /// All joints, parents before their children.
    pub(crate) order: JointOrder,
    /// Mass of the whole robot (kg).
    pub mass: f64,
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

/// The axis of a joint. Nearly all are along a coordinate, where a rotation touches two columns only.
#[derive(Clone, Copy, Debug)]
pub(crate) enum JointAxis {
    X,
    Y,
    Z,
    About(Unit<Vector3<f64>>),
}

impl Tree {
    /// The tree of a mechanism.
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
        Self { nodes, order: mechanism.order, mass: mechanism.mass() }
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

impl JointAxis {
    pub(crate) fn new(axis: Unit<Vector3<f64>>) -> Self {
        if axis == Vector3::x_axis() {
            JointAxis::X
        } else if axis == Vector3::y_axis() {
            JointAxis::Y
        } else if axis == Vector3::z_axis() {
            JointAxis::Z
        } else {
            JointAxis::About(axis)
        }
    }

    /// The child's rotation and the joint's axis in the world, from the parent's rotation and sine and cosine of the
    /// angle.
    #[inline(always)]
    pub(crate) fn apply(self, parent: &Matrix3<f64>, (sine, cosine): (f64, f64)) -> (Matrix3<f64>, Vector3<f64>) {
        let (x, y, z) = (parent.column(0), parent.column(1), parent.column(2));
        match self {
            JointAxis::X => {
                (Matrix3::from_columns(&[x.into(), y * cosine + z * sine, z * cosine - y * sine]), x.into())
            }
            JointAxis::Y => {
                (Matrix3::from_columns(&[x * cosine - z * sine, y.into(), x * sine + z * cosine]), y.into())
            }
            JointAxis::Z => {
                (Matrix3::from_columns(&[x * cosine + y * sine, y * cosine - x * sine, z.into()]), z.into())
            }
            JointAxis::About(axis) => {
                let across = axis.cross_matrix() * sine + axis.into_inner() * axis.transpose() * (1.0 - cosine);
                let rotation = Matrix3::from_diagonal_element(cosine) + across;
                (parent * rotation, parent * axis.into_inner())
            }
        }
    }
}
