//! Where an imported robot came from: its URDF, and which of the URDF's joints is which.

use nalgebra::{UnitQuaternion, Vector3};

use crate::{HeldJoint, PerJoint};

/// The URDF that a mechanism was imported from.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfSource {
    /// The URDF's file, beside the mechanism's.
    pub file: String,
    /// The URDF's link that carries the inertial measurement unit.
    pub trunk_link: String,
    /// Maps coordinates of the URDF's root link to x ahead, y left, z up, in the standing posture (-).
    pub root_to_stand: UnitQuaternion<f64>,
    /// The points under the right and the left ankle, in coordinates of the URDF's root link, in that posture (m).
    pub soles_in_root: [Vector3<f64>; 2],
    /// The URDF's joint for each joint of the mechanism; `None` for those that the robot does not have.
    pub joints: PerJoint<Option<UrdfJoint>>,
    /// The other joints of the URDF, which their drives hold.
    pub held: Vec<HeldJoint>,
}

/// A joint of a URDF.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfJoint {
    /// Its name in the URDF.
    pub name: String,
    /// Its angle in the URDF per angle of the mechanism: 1 or −1 (-).
    pub sign: f64,
}
