//! The mirror: what the robot does on its left foot, told as if it stood on its right (DESIGN §4.5, the swap).
//!
//! Reflection in the sagittal plane exchanges right and left and keeps rotations about y, while rotations about x and z
//! change sign. The chain from foot to foot is also walked the other way round, which changes the sign once more: so in
//! the legs pitch exchanges with −, roll and yaw with +. The minus signs of the paper's eq. (2) come from here.

use crate::{Joint, JointVector, Mechanism, PerJoint};

/// How joint angles, rates, accelerations and torques are relabelled at a swap. Applied twice it is the identity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    partner: PerJoint<Joint>,
    sign: PerJoint<f64>,
}

impl Mirror {
    /// The mirror of a mechanism, whose axes say which joints change sign.
    ///
    /// `None` when the mechanism is no mirror image of itself: a joint's axis is neither along nor across y as its
    /// partner's is.
    pub fn new(mechanism: &Mechanism) -> Option<Self> {
        let mut sign = PerJoint([0.0; Joint::COUNT]);
        for joint in Joint::ALL {
            let axis = mechanism.links[joint].axis;
            let partner = mechanism.links[partner(joint)].axis;
            // A rotation axis is an axial vector: a reflection in y keeps its y and turns the rest round.
            let along = axis.x * -partner.x + axis.y * partner.y + axis.z * -partner.z;
            if (along.abs() - 1.0).abs() > 1e-9 {
                return None;
            }
            sign[joint] = along.signum() * if joint.is_in_leg() { -1.0 } else { 1.0 };
        }
        Some(Self { partner: PerJoint::from_fn(partner), sign })
    }

    /// The mirror image of one value per joint (angles, rates, accelerations, torques).
    #[inline]
    pub fn apply(&self, values: &JointVector) -> JointVector {
        PerJoint::from_fn(|joint| self.sign[joint] * values[self.partner[joint]])
    }

    /// The joint that takes this joint's place.
    pub fn partner(&self, joint: Joint) -> Joint {
        self.partner[joint]
    }

    /// The sign with which a joint's value is taken over.
    pub fn sign(&self, joint: Joint) -> f64 {
        self.sign[joint]
    }
}

/// The joint on the other side that does what `joint` does here.
pub const fn partner(joint: Joint) -> Joint {
    use Joint::*;
    match joint {
        RightAnkleRoll => LeftAnkleRoll,
        RightAnklePitch => LeftAnklePitch,
        RightKnee => LeftKnee,
        RightHipPitch => LeftHipPitch,
        RightHipYaw => LeftHipYaw,
        RightHipRoll => LeftHipRoll,
        LeftAnkleRoll => RightAnkleRoll,
        LeftAnklePitch => RightAnklePitch,
        LeftKnee => RightKnee,
        LeftHipPitch => RightHipPitch,
        LeftHipYaw => RightHipYaw,
        LeftHipRoll => RightHipRoll,
        RightShoulder => LeftShoulder,
        RightElbow => LeftElbow,
        LeftShoulder => RightShoulder,
        LeftElbow => RightElbow,
        FootRoll | FootPitch | WaistPitch | WaistRoll => joint,
    }
}
