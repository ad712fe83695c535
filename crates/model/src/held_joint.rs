//! Held joints: those of an imported robot that have no role, and that their drives hold at an angle of choice.

use nalgebra::{Unit, Vector3};

use crate::{Body, Joint, TorqueSource};

/// A joint of a URDF that is held.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldJoint {
    /// Its name in the URDF.
    pub name: String,
    /// The angle at which it is held, in the URDF's sign (rad).
    pub angle: f64,
    /// The link that it carries; `None` for one that is welded, as all were until 0.1.0.
    pub link: Option<HeldLink>,
}

/// A held joint's link and drive. With the joint at its angle, the link's frame is parallel to those of all other
/// links of the robot standing straight; its origin is on the joint.
///
/// The mechanism's links contain the bodies of held ones, as if these were welded: see
/// [`Mechanism::unlumped`](crate::Mechanism::unlumped).
#[derive(Clone, Debug, PartialEq)]
pub struct HeldLink {
    /// The mechanism's link on which it sits, by itself or on other held ones.
    pub mount: Joint,
    /// The held joint that carries this one, by its place among the held ones; `None` for one that the mount carries.
    pub below: Option<usize>,
    /// Axis of rotation, a unit vector; rotation is right-handed.
    pub axis: Unit<Vector3<f64>>,
    /// Position of the joint in the frame of what carries it (m).
    pub origin: Vector3<f64>,
    /// Mass and inertia of the link; [`Body::NONE`] if it has none beside those of what it carries.
    pub body: Body,
    /// The mechanism's link that contains this body.
    pub lumped_into: Joint,
    /// The mechanism's joints that it carries; their `parent` is the mount.
    pub carries: Vec<Joint>,
    /// Effort and rotor inertia of its drive.
    pub drive: TorqueSource,
}

impl HeldLink {
    /// Most held joints that have a link by themselves.
    pub const COUNT_MAX: usize = 64;
}
