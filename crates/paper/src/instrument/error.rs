//! Why there is no answer to a question.

use config::ConfigErrors;
use gait::WalkError;

use crate::SearchError;

/// Why there is no answer to a question.
#[derive(Debug, thiserror::Error)]
pub enum InstrumentError {
    /// A file that the instrument begins with is wrong.
    #[error(transparent)]
    File(#[from] ConfigErrors),
    /// There is no number of this name.
    #[error("{name}: unknown number; the numbers are {}", known.join(", "))]
    UnknownNumber {
        /// The name in the question.
        name: String,
        /// All names.
        known: Vec<&'static str>,
    },
    /// A number is far from anything plausible.
    #[error("{name} = {value}: must lie between {} and {}", reach[0], reach[1])]
    OutOfReach {
        /// The number's name.
        name: &'static str,
        /// Its value in the question, in the unit of its name.
        value: f64,
        /// The least and the greatest value that can be tried, in the same unit.
        reach: [f64; 2],
    },
    /// A choice that there is not.
    #[error("{name} = \"{chosen}\": must be one of {}", known.join(", "))]
    UnknownChoice {
        /// What is chosen.
        name: &'static str,
        /// The choice in the question.
        chosen: String,
        /// All choices.
        known: Vec<String>,
    },
    /// There is no figure of this number.
    #[error("figure {0}: there is no scenario of it")]
    UnknownFigure(u64),
    /// The body cannot walk so.
    #[error("with these numbers it cannot walk: {0}")]
    CannotWalk(#[from] SearchError),
}

impl From<WalkError> for InstrumentError {
    fn from(error: WalkError) -> Self {
        Self::CannotWalk(error.into())
    }
}
