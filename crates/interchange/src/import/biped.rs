//! A biped standing straight: joints as points and axes, bodies between them, all in one frame: x ahead, y left, z up,
//! y = 0 in the middle between the legs.

use nalgebra::{Unit, Vector3};

use crate::import::body::LumpedBody;
use crate::import::drive::JointDrive;
use crate::import::role::LegRole;

/// A joint as a point and an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hinge {
    /// Index among the URDF's joints.
    pub urdf: usize,
    /// A point on the axis (m): the URDF's origin of the joint.
    pub place: Vector3<f64>,
    /// Axis about which the body that the joint carries turns, the component of its role positive.
    pub axis: Unit<Vector3<f64>>,
    /// Angle in the URDF = sign · angle about `axis`.
    pub sign: f64,
    /// Range, rate and torque; the range about `axis`.
    pub drive: JointDrive,
}

/// A joint of a leg or an arm, and the body beyond it, away from the trunk.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub hinge: Hinge,
    pub body: LumpedBody,
}

/// The biped.
#[derive(Clone, Debug)]
pub(super) struct Biped {
    /// What the joints of both legs do, from the pelvis down.
    pub roles: [LegRole; 6],
    /// Right and left leg, from the pelvis down; the last body is the foot.
    pub legs: [[Segment; 6]; 2],
    /// The body on which the legs hang; massless where that is the trunk.
    pub pelvis: LumpedBody,
    /// The joints that pitch and roll the trunk.
    pub waist: Option<[Hinge; 2]>,
    /// Where the trunk is mounted if there is no such waist (m).
    pub mount: Vector3<f64>,
    /// The body between the two joints of the waist, and the trunk with head and all that is held on it.
    pub middle: LumpedBody,
    pub trunk: LumpedBody,
    /// Right and left arm, as many segments in each: upper arm and forearm, one of both together, or none.
    pub arms: [Vec<Segment>; 2],
}

impl Biped {
    /// A joint of a leg by its role.
    pub(super) fn hinge(&self, side: usize, role: LegRole) -> &Hinge {
        &self.legs[side][self.roles.iter().position(|own| *own == role).unwrap_or_default()].hinge
    }

    /// The ankle of a foot: x and z of the pitch axis, y of the roll axis (m).
    pub(super) fn ankle(&self, side: usize) -> Vector3<f64> {
        let (pitch, roll) = (self.hinge(side, LegRole::AnklePitch).place, self.hinge(side, LegRole::AnkleRoll).place);
        Vector3::new(pitch.x, roll.y, pitch.z)
    }

    /// Mass (kg).
    pub(super) fn mass(&self) -> f64 {
        let limbs = self.legs.iter().flatten().chain(self.arms.iter().flatten());
        limbs.map(|segment| segment.body.mass).sum::<f64>() + self.pelvis.mass + self.middle.mass + self.trunk.mass
    }
}
