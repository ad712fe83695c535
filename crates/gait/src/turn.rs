//! Turning (DESIGN §4.1, paper eqs. 1 and 2): the swing foot lands turned out by `α`.
//!
//! Half of `α` goes into either hip yaw, joints 7 and 10. One half-step deflects (eq. 1), the next restores (eq. 2), so
//! that the feet are parallel before the next deflection begins: a full step turns the walk by `α`, positive to the
//! left. Turning left deflects while standing on the right foot, turning right while standing on the left: the foot
//! always turns *out*. Hip yaw keeps its sign at the support change, so in canonical coordinates either is a positive
//! offset `|α|/2`.
//!
//! The yaw is about the pelvis' vertical as long as pitch and roll add up to zero from the sole to the hip yaw. They do
//! in pitch while the nominal's pelvis is upright. Roll lies beyond the yaw, at the hip: while the support leg leans
//! sideways the swinging sole tilts by up to about lean times `α` (tests/a_full_step_turns_the_walk.rs).

use model::{Joint, JointVector, Mechanism};

use crate::{Deflection, RampKind, WalkError};

/// The joints that turn in the paper.
const HIP_YAWS: [Joint; 2] = [Joint::RightHipYaw, Joint::LeftHipYaw];

impl Deflection {
    /// No turn: walking straight on. Its angle is `α`, the change of heading per full step.
    pub fn turn(mechanism: &Mechanism, kind: RampKind) -> Self {
        let mut apart = JointVector::ZERO;
        for joint in HIP_YAWS {
            apart[joint] = mechanism.links[joint].axis.z.signum();
        }
        Self::new(apart, kind)
    }
}

/// Checks that offsets of the hip yaws alone turn the walk, as in the paper.
///
/// # Errors
/// [`WalkError::HipYawNotVertical`] when joint 7 or 10 does not turn about z.
pub(crate) fn check_joints(mechanism: &Mechanism) -> Result<(), WalkError> {
    let axes = HIP_YAWS.map(|joint| (joint, mechanism.links[joint].axis.into_inner()));
    match axes.into_iter().find(|(_, axis)| axis.z.abs() < 1.0 - 1e-9) {
        Some((joint, axis)) => Err(WalkError::HipYawNotVertical { joint, axis }),
        None => Ok(()),
    }
}
