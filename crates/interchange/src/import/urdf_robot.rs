//! Links and joints of a URDF. Everything else in the file is ignored.

use nalgebra::{Isometry3, Unit, Vector3};

use crate::import::body::LumpedBody;

/// A robot as its URDF describes it: one tree.
#[derive(Clone, Debug)]
pub(super) struct UrdfRobot {
    pub name: String,
    pub links: Vec<UrdfLink>,
    pub joints: Vec<UrdfTreeJoint>,
    /// Index of the link that is no joint's child.
    pub root: usize,
}

/// A link.
#[derive(Clone, Debug)]
pub(super) struct UrdfLink {
    pub name: String,
    /// Line in the file.
    pub line: usize,
    /// Mass and inertia in the link's frame; zero without an `<inertial>`.
    pub body: LumpedBody,
    /// Collision shapes that are no meshes.
    pub shapes: Vec<Shape>,
}

/// A collision shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// Maps the shape's coordinates to the link's.
    pub pose: Isometry3<f64>,
    pub solid: Solid,
}

/// Form of a shape (m); a cylinder stands along z.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solid {
    Box(Vector3<f64>),
    Cylinder { radius: f64, length: f64 },
    Sphere { radius: f64 },
}

/// What a joint lets move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JointKind {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
    Floating,
    Planar,
}

/// A joint.
#[derive(Clone, Debug)]
pub(super) struct UrdfTreeJoint {
    pub name: String,
    /// Line in the file.
    pub line: usize,
    pub kind: JointKind,
    /// Indices of the links that it connects.
    pub parent: usize,
    pub child: usize,
    /// Maps the child's coordinates at zero to the parent's.
    pub origin: Isometry3<f64>,
    /// Axis in the child's frame.
    pub axis: Unit<Vector3<f64>>,
    pub limit: UrdfLimit,
    pub mimic: Option<Mimic>,
}

/// Limits of a joint as written (rad or m).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct UrdfLimit {
    /// Whether there is a `<limit>`, and one that tells both ends.
    pub given: bool,
    pub complete: bool,
    pub lower: f64,
    pub upper: f64,
    /// Largest rate and effort; `None` where absent.
    pub velocity: Option<f64>,
    pub effort: Option<f64>,
}

/// A joint that follows another one: angle = factor · its angle + offset.
#[derive(Clone, Debug)]
pub(super) struct Mimic {
    pub joint: String,
    pub factor: f64,
    pub offset: f64,
}

impl JointKind {
    /// The kind as a URDF writes it.
    pub(super) const fn name(self) -> &'static str {
        match self {
            JointKind::Revolute => "revolute",
            JointKind::Continuous => "continuous",
            JointKind::Prismatic => "prismatic",
            JointKind::Fixed => "fixed",
            JointKind::Floating => "floating",
            JointKind::Planar => "planar",
        }
    }
}

impl UrdfTreeJoint {
    /// Whether it turns about one axis.
    pub(super) fn turns(&self) -> bool {
        matches!(self.kind, JointKind::Revolute | JointKind::Continuous)
    }
}
