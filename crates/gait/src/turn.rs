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

use model::{Joint, JointVector, Mechanism, Motion, Side};

use crate::deflection::Deflection;
use crate::{DeflectionPhase, RampKind, RampState, WalkError};

/// The joints that turn in the paper.
const HIP_YAWS: [Joint; 2] = [Joint::RightHipYaw, Joint::LeftHipYaw];

/// The commanded turn and its offset in the present half-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// One on each hip yaw, with the sign that turns the feet apart.
    apart: JointVector,
    /// `α`, half of it on either hip.
    deflection: Deflection,
}

impl Turn {
    /// No turn: walking straight on.
    pub fn new(mechanism: &Mechanism, kind: RampKind) -> Self {
        let mut apart = JointVector::ZERO;
        for joint in HIP_YAWS {
            apart[joint] = mechanism.links[joint].axis.z.signum();
        }
        Self { apart, deflection: Deflection::new(kind) }
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

    /// `α` as commanded: change of heading per full step (rad), positive to the left.
    pub fn angle(&self) -> f64 {
        self.deflection.angle()
    }

    /// The part of the present half-step.
    pub fn phase(&self) -> DeflectionPhase {
        self.deflection.phase()
    }

    /// Commands a turn by `angle` per full step (rad), from the next deflecting half-step on.
    pub fn request(&mut self, angle: f64) {
        self.deflection.request(angle);
    }

    /// Number of half-steps from the present one, on `support`, until a change to `angle` takes effect: where the next
    /// deflection for it begins; for a change to straight on, where the next deflection is omitted.
    pub fn delay(&self, angle: f64, support: Side) -> u64 {
        self.deflection.delay(angle, support)
    }

    /// Begins a half-step on `support`. After a deflection it restores, whatever the command.
    pub fn begin_half_step(&mut self, support: Side) {
        self.deflection.begin_half_step(support);
    }

    /// The offset of either hip at `progress` (rad), with derivatives by progress.
    pub fn per_hip(&self, progress: f64) -> RampState {
        self.deflection.per_leg(progress)
    }

    /// The offsets of all joints at `progress`, canonical, at nominal speed in a half-step of `duration` (s).
    pub fn at(&self, progress: f64, duration: f64) -> Motion {
        let per_hip = self.per_hip(progress).by(duration.recip());
        Motion {
            angles: self.apart * per_hip.value,
            rates: self.apart * per_hip.rate,
            accelerations: self.apart * per_hip.acceleration,
        }
    }
}
