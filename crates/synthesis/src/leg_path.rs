//! What a leg pattern prescribes: the paths of the pelvis and of the swing foot over the half-step.
//!
//! Pelvis and feet stay parallel to the world, so each is a moving point, told in support coordinates. The end is the
//! mirror image of the start in position and velocity, and the swing foot starts and lands at rest: no impact.

use model::{Joint, Mechanism};

use crate::jet::{Jet, PointMotion};
use crate::pendulum_path::PendulumPath;
use crate::recorded_path::RecordedPath;
use crate::{Parameters, Recording, SynthesisError};

/// Where the shape of the leg motion comes from.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum LegPattern {
    /// From the [`Parameters`] alone: the pelvis goes like an inverted pendulum, the swing foot on an arch.
    #[default]
    Pendulum,
    /// The shape of a recorded gait, fitted to the [`Parameters`].
    Recorded(Recording),
}

/// Paths over the progress of the half-step, which is a [`Jet`] from 0 to 1.
pub trait LegPath {
    /// The middle between the hip joints.
    fn pelvis(&self, progress: Jet) -> PointMotion;

    /// The left sole's origin, under its ankle.
    fn swing_sole(&self, progress: Jet) -> PointMotion;
}

impl LegPattern {
    pub(crate) fn path(
        &self,
        mechanism: &Mechanism,
        parameters: &Parameters,
    ) -> Result<Box<dyn LegPath>, SynthesisError> {
        let pendulum = PendulumPath::new(mechanism, parameters);
        Ok(match self {
            LegPattern::Pendulum => Box::new(pendulum),
            LegPattern::Recorded(recording) => Box::new(RecordedPath::new(mechanism, pendulum, recording)?),
        })
    }
}

/// Distance between the hip joints, and of the feet beside each other [m].
pub fn hip_distance(mechanism: &Mechanism) -> f64 {
    mechanism.links[Joint::LeftHipRoll].origin.y
}
