//! What a search may change.

use super::open_number::OPEN_COUNT;

/// What a search may change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// For each of [`OPEN_NUMBERS`](super::OPEN_NUMBERS), whether it may differ from the folder's.
    pub numbers: [bool; OPEN_COUNT],
    /// Whether the ramps of turn and extension may.
    pub ramps: bool,
    /// Whether the axes of the joints may.
    pub axes: bool,
}
