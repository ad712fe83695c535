//! What the controller is doing, and what it is asked to do. One file per mode that moves by itself.

mod holding;

pub use holding::Holding;

/// What the controller is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Half-step after half-step.
    Walking,
    /// On both feet: braking, then still.
    Holding,
    /// On both feet, the weight going to the foot that is to bear first.
    Starting,
    /// The robot lies; nothing moves.
    Fallen,
}

/// What an operator wants the controller to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Intent {
    /// Walk on.
    Walk,
    /// Stop at the end of this half-step.
    Stop,
    /// The same for now: stand on both feet and hold the posture.
    Hold,
}
