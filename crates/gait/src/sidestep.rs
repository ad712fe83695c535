//! Sidestepping: the swing foot lands further aside by `γ` at the hips, as the paper turns and lengthens a step.
//!
//! Half of `γ` goes into either hip roll, joints 8 and 9, and the ankle rolls take it back so that the soles stay
//! level. One half-step deflects, the next restores: the foot on the side of the walk leads away, the other one follows
//! until the feet are as far apart as before. A full step moves the walk aside by about `2·l·sin(γ/2)` with legs of
//! length `l`, positive to the left. For an offset `g` of either leg, away from the other one, the support leg leans
//! outward as one goes up from the ground (ankle `−g`, hip `+g` about x), the swing leg as one goes down from the
//! pelvis (hip `+g`, ankle `−g`). Roll keeps its sign at the support change.

use model::{Joint, JointVector, Mechanism, Motion, Side};

use crate::deflection::Deflection;
use crate::{DeflectionPhase, RampKind, RampState, WalkError};

/// Hip roll and ankle joints of each leg.
const LEGS: [(Side, Joint, [Joint; 2]); 2] = [
    (Side::Right, Joint::RightHipRoll, [Joint::RightAnkleRoll, Joint::RightAnklePitch]),
    (Side::Left, Joint::LeftHipRoll, [Joint::LeftAnkleRoll, Joint::LeftAnklePitch]),
];

/// The commanded sidestep and its offset in the present half-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sidestep {
    /// One on each hip and ankle roll, with the sign that spreads the legs.
    apart: JointVector,
    /// `γ`, half of it on either hip.
    deflection: Deflection,
}

impl Sidestep {
    /// No sidestep.
    pub fn new(mechanism: &Mechanism, kind: RampKind) -> Self {
        let mut apart = JointVector::ZERO;
        let x = |joint: Joint| mechanism.links[joint].axis.x;
        for (_, hip, [one, other]) in LEGS {
            // Which of the two ankle joints rolls is data: the mechanism's axes decide, not the joint's name.
            let ankle = if x(one).abs() >= x(other).abs() { one } else { other };
            apart[hip] = x(hip).signum();
            apart[ankle] = -x(ankle).signum();
        }
        Self { apart, deflection: Deflection::new(kind) }
    }

    /// Checks that offsets of the roll joints alone spread the legs and keep the soles level.
    ///
    /// # Errors
    /// [`WalkError::HipRollNotForward`] and [`WalkError::NoAnkleRoll`] when a leg has no such pair of joints about x.
    pub(crate) fn check_joints(mechanism: &Mechanism) -> Result<(), WalkError> {
        let axis = |joint: Joint| mechanism.links[joint].axis.into_inner();
        let rolls = |joint: Joint| axis(joint).x.abs() > 1.0 - 1e-9;
        for (side, hip, ankle) in LEGS {
            if !rolls(hip) {
                return Err(WalkError::HipRollNotForward { joint: hip, axis: axis(hip) });
            }
            if !ankle.into_iter().any(rolls) {
                return Err(WalkError::NoAnkleRoll { side, ankle });
            }
        }
        Ok(())
    }

    /// `γ` as commanded (rad), positive to the left.
    pub fn angle(&self) -> f64 {
        self.deflection.angle()
    }

    /// The part of the present half-step.
    pub fn phase(&self) -> DeflectionPhase {
        self.deflection.phase()
    }

    /// Commands a sidestep by `angle` (rad), from the next deflecting half-step on.
    pub fn request(&mut self, angle: f64) {
        self.deflection.request(angle);
    }

    /// Number of half-steps from the present one, on `support`, until a change to `angle` takes effect: where the next
    /// foot leads away; for a change to none, where it no longer does.
    pub fn delay(&self, angle: f64, support: Side) -> u64 {
        self.deflection.delay(angle, support)
    }

    /// Begins a half-step on `support`. After a deflection it restores, whatever the command.
    pub fn begin_half_step(&mut self, support: Side) {
        self.deflection.begin_half_step(support);
    }

    /// `g`, the offset of either leg at `progress` (rad), with derivatives by progress.
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
