//! Step extension (DESIGN §4.3): the swing foot lands further ahead by `β` at the hips.
//!
//! Half of `β` goes into either hip pitch, joints 6 and 11, and the ankle pitches take it back so that the soles stay
//! level. For a forward-reaching offset `e` of either hip the signs follow from the axes: the support leg leans ahead
//! as one goes up from the ground (ankle `+e`, hip `−e`), the swing leg reaches ahead as one goes down from the pelvis
//! (hip `−e`, ankle `+e`). Pitch changes its sign at the support change: the foot that reached ahead by `e` is then the
//! one left behind, `−e`. So in steady extended walking `e` runs from `−β/2` to `+β/2` in each half-step. Negative `β`
//! shortens.
//!
//! Ankle pitch, knee and hip pitch follow each other about one direction, so the soles stay level exactly, whatever the
//! roll and yaw. Under the other reading of the paper, where joints 3 and 14 pitch, roll comes between: there the sole
//! tilts by about the product of the ankle's roll and `e`.

use model::{Joint, JointVector, Mechanism, Motion, Side};

use crate::{Ramp, RampKind, RampState, WalkError};

/// Hip pitch and ankle joints of each leg.
const LEGS: [(Side, Joint, [Joint; 2]); 2] = [
    (Side::Right, Joint::RightHipPitch, [Joint::RightAnklePitch, Joint::RightAnkleRoll]),
    (Side::Left, Joint::LeftHipPitch, [Joint::LeftAnklePitch, Joint::LeftAnkleRoll]),
];

/// The commanded step extension and its offset in the present half-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepExtension {
    /// One on each ankle and hip pitch, with the sign that reaches forward.
    forward: JointVector,
    /// Shape of the ramps.
    kind: RampKind,
    /// `β` as commanded (rad).
    angle: f64,
    /// `e`: offset of either hip over progress (rad).
    ramp: Ramp,
}

impl StepExtension {
    /// No extension: steps as long as the nominal's.
    pub fn new(mechanism: &Mechanism, kind: RampKind) -> Self {
        let mut forward = JointVector::ZERO;
        let y = |joint: Joint| mechanism.links[joint].axis.y;
        for (_, hip, [one, other]) in LEGS {
            // Which of the two ankle joints pitches is data: the mechanism's axes decide, not the joint's name.
            let ankle = if y(one).abs() >= y(other).abs() { one } else { other };
            forward[hip] = -y(hip).signum();
            forward[ankle] = y(ankle).signum();
        }
        Self { forward, kind, angle: 0.0, ramp: Ramp::hold(0.0) }
    }

    /// Checks that offsets of the pitch joints alone lengthen the step and keep the soles level, as in the paper.
    ///
    /// # Errors
    /// [`WalkError::HipPitchNotLateral`] and [`WalkError::NoAnklePitch`] when a leg has no such pair of joints about y.
    pub(crate) fn check_joints(mechanism: &Mechanism) -> Result<(), WalkError> {
        let axis = |joint: Joint| mechanism.links[joint].axis.into_inner();
        let pitches = |joint: Joint| axis(joint).y.abs() > 1.0 - 1e-9;
        for (side, hip, ankle) in LEGS {
            if !pitches(hip) {
                return Err(WalkError::HipPitchNotLateral { joint: hip, axis: axis(hip) });
            }
            if !ankle.into_iter().any(pitches) {
                return Err(WalkError::NoAnklePitch { side, ankle });
            }
        }
        Ok(())
    }

    /// `β` as commanded (rad).
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// Commands an extension by `angle` (rad), from the next half-step on.
    pub fn request(&mut self, angle: f64) {
        self.angle = angle;
    }

    /// Begins a half-step: the leg that reached ahead is now the rear one.
    pub fn begin_half_step(&mut self) {
        self.ramp = Ramp::new(self.kind, self.ramp.end().negated(), 0.5 * self.angle);
    }

    /// Lets the present half-step end with the extension commanded last, from a progress on.
    pub(crate) fn redirect(&mut self, progress: f64) {
        self.ramp = self.ramp.redirected(self.kind, progress, 0.5 * self.angle);
    }

    /// Ends the present half-step with another offset of either hip than commanded (rad), from where it began.
    pub(crate) fn aim(&mut self, per_hip: f64) {
        self.ramp = Ramp::new(self.kind, self.ramp.at(0.0), per_hip);
    }

    /// `e`, the offset of either hip at `progress` (rad), with derivatives by progress.
    pub fn per_hip(&self, progress: f64) -> RampState {
        self.ramp.at(progress)
    }

    /// The offsets of all joints at `progress`, canonical, at nominal speed in a half-step of `duration` (s).
    pub fn at(&self, progress: f64, duration: f64) -> Motion {
        let per_hip = self.per_hip(progress).by(duration.recip());
        Motion {
            angles: self.forward * per_hip.value,
            rates: self.forward * per_hip.rate,
            accelerations: self.forward * per_hip.acceleration,
        }
    }
}
