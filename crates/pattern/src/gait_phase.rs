//! What a gait does at this instant.

use crate::Stance;

/// What a gait does at this instant, where [`GaitState`](crate::GaitState) is what is planned for the newest knot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GaitPhase {
    /// Standing on both feet.
    Standing(Stance),
    /// On both feet, the weight shifting to the first support foot.
    Starting,
    /// Half-step after half-step.
    Walking,
    /// Half-steps without progress.
    InPlace,
    /// The last half-steps before a stand.
    Stopping,
}
