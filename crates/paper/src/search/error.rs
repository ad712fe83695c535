//! Why a search, or a candidate of one, is not possible.

use config::ConfigErrors;
use gait::{TableFileError, WalkError};
use synthesis::SynthesisError;

/// Why a search, or a candidate of one, is not possible.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// A mechanism's file is wrong, or a candidate's would be.
    #[error(transparent)]
    Mechanism(#[from] ConfigErrors),
    /// The body cannot walk the nominal half-step.
    #[error(transparent)]
    Synthesis(#[from] SynthesisError),
    /// The mechanism cannot turn or extend its steps.
    #[error(transparent)]
    Walk(#[from] WalkError),
    /// The half-step cannot be written.
    #[error(transparent)]
    Table(TableFileError),
    /// A mechanism's file cannot be scaled.
    #[error(
        "{file}: the search scales segments, which it can only where the mechanism has no [source], three moments in \
         each inertia_kg_m2, and right_hip_roll as the parent of joint.left_hip_roll; search from the paper's robot"
    )]
    NotScalable {
        /// The mechanism's file.
        file: String,
    },
    /// A file lacks a key that is to get another value.
    #[error("{file}: lacks a key that the search would change; write it out, as config/ has it")]
    Unwritable {
        /// The file.
        file: String,
    },
}
