//! The mirror: a motion on the left foot, expressed as if the robot stood on its right foot (DESIGN §4.5, the support
//! change).
//!
//! Reflection in the sagittal plane exchanges right and left and keeps rotations about y, while rotations about x and z
//! change sign. The order of the chain from foot to foot is also reversed, which changes the sign once more: so in the
//! legs pitch exchanges with −, roll and yaw with +. The minus signs of the paper's eq. (2) come from here.

use crate::{Joint, JointVector, Mechanism, PerJoint, Side};

/// A quantity with a mirror image in the sagittal plane.
pub trait Mirrored {
    /// The mirror image. Mirrored twice, every quantity is itself again.
    ///
    /// * `mirror` – exchanges the joints of the two sides; a quantity without joints does not need it
    #[must_use]
    fn mirrored(&self, mirror: &Mirror) -> Self;
}

impl Mirrored for JointVector {
    fn mirrored(&self, mirror: &Mirror) -> Self {
        mirror.apply(self)
    }
}

/// How joint angles, rates, accelerations and torques are relabelled when the support foot changes. Applied twice it is
/// the identity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    partner: PerJoint<Joint>,
    sign: PerJoint<f64>,
}

impl Mirror {
    /// The mirror of a mechanism; the axes determine which joints change sign.
    ///
    /// `None` when the mechanism is not left–right symmetric: a joint's axis is neither along nor across y as its
    /// partner's is.
    pub fn new(mechanism: &Mechanism) -> Option<Self> {
        let mut sign = PerJoint([0.0; Joint::COUNT]);
        for joint in Joint::ALL {
            let axis = mechanism.links[joint].axis;
            let partner = mechanism.links[partner(joint)].axis;
            // A rotation axis is an axial vector: a reflection in y keeps its y and reverses the rest.
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

    /// Expresses a physical quantity in support coordinates, as if the robot stood on its right foot: unchanged with
    /// `support` on the right, mirrored with `support` on the left.
    pub fn to_support<T: Mirrored + Clone>(&self, support: Side, physical: &T) -> T {
        match support {
            Side::Right => physical.clone(),
            Side::Left => physical.mirrored(self),
        }
    }

    /// Expresses a quantity of support coordinates in physical ones: the inverse of [`to_support`](Self::to_support).
    pub fn to_physical<T: Mirrored + Clone>(&self, support: Side, in_support: &T) -> T {
        self.to_support(support, in_support)
    }

    /// The joint that takes this joint's place.
    pub fn partner(&self, joint: Joint) -> Joint {
        self.partner[joint]
    }

    /// The sign with which a joint takes over its partner's value: 1 or −1.
    pub fn sign(&self, joint: Joint) -> f64 {
        self.sign[joint]
    }
}

/// The corresponding joint on the other side; the joint itself in the middle of the body.
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
