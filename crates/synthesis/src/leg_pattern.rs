//! The source of the leg motion's shape.

use model::Mechanism;

use crate::leg_path::LegPath;
use crate::pendulum_path::PendulumPath;
use crate::recorded_path::RecordedPath;
use crate::{GaitRecording, SynthesisError, SynthesisParameters};

/// The source of the leg motion's shape.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum LegPattern {
    /// The [`SynthesisParameters`] alone: the pelvis moves like an inverted pendulum, the swing foot on an arch.
    #[default]
    Pendulum,
    /// The shape of a recorded gait, fitted to the [`SynthesisParameters`].
    Recorded(GaitRecording),
}

impl LegPattern {
    /// The paths of pelvis and swing foot.
    pub(crate) fn path(
        &self,
        mechanism: &Mechanism,
        parameters: &SynthesisParameters,
    ) -> Result<Box<dyn LegPath>, SynthesisError> {
        let pendulum = PendulumPath::new(mechanism, parameters);
        Ok(match self {
            LegPattern::Pendulum => Box::new(pendulum),
            LegPattern::Recorded(recording) => Box::new(RecordedPath::new(mechanism, pendulum, recording)?),
        })
    }
}
