//! A residual on the joint angles: what a learned policy in the same process adds to the walk.

use model::{Joint, JointVector, Motion, PerJoint};
use signal::CriticallyDamped;

/// Time constant with which the residual follows what is asked for (s): drives follow no jump.
const TIME_CONSTANT: f64 = 0.02;

/// Most that is added to an angle (rad): a correction of the walk, not another motion.
const MOST: f64 = 0.3;

/// What is added to the joint angles.
#[derive(Clone, Debug, Default)]
pub(crate) struct JointResidual {
    /// What was asked for (rad).
    target: JointVector,
    /// What is added (rad), on its way there.
    added: PerJoint<CriticallyDamped<f64>>,
    /// Whether anything was ever asked for: without, the motion stays as it is, to the bit.
    is_used: bool,
}

impl JointResidual {
    /// Asks for angles (rad): bounded, and nothing for what is not finite.
    pub(crate) fn set(&mut self, residual: &JointVector) {
        let bounded = |joint| {
            let angle: f64 = residual[joint];
            if angle.is_finite() { angle.clamp(-MOST, MOST) } else { 0.0 }
        };
        self.target = JointVector::from_fn(bounded);
        self.is_used |= self.target != JointVector::ZERO;
    }

    /// The motion of a period of `dt` seconds, with the residual.
    pub(crate) fn added_to(&mut self, mut motion: Motion, dt: f64) -> Motion {
        if self.is_used {
            for joint in Joint::ALL {
                self.added[joint].advance(self.target[joint], TIME_CONSTANT, dt);
                motion.angles[joint] += self.added[joint].value;
                motion.rates[joint] += self.added[joint].rate;
            }
        }
        motion
    }
}
