//! What the controller is doing, and what it is asked to do. One file per mode that moves by itself.

mod holding;
mod rising;

pub use holding::Holding;
pub use rising::Rising;

/// What the controller is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// On both feet, side by side.
    Standing,
    /// On both feet, the weight going to the foot that is to bear first; or getting back to a stand after a reset.
    Starting,
    /// Half-step after half-step.
    Walking,
    /// The same without getting ahead.
    InPlace,
    /// The last half-steps before a stand.
    Stopping,
    /// On both feet, in stride.
    Holding,
    /// The robot lies; nothing moves until a reset.
    Fallen,
    /// Something went wrong that the controller will not walk on after: it stands until a reset.
    Faulted,
}

/// What an operator wants the controller to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Intent {
    /// Walk, or walk on.
    Walk,
    /// Step in place: half-steps of no length, turning if a turn is asked, until something else is asked.
    InPlace,
    /// Come to a stand with the feet side by side; from a stand in stride by one more half-step.
    Stop,
    /// Pause: come to a stand in stride.
    Hold,
    /// Take back a latched fault, or come back to a stand once the robot was put on its feet.
    Reset,
}
