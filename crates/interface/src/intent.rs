//! What an operator wants the robot to do.

use crate::code::codes;

codes! {
    /// What an operator wants the robot to do.
    Intent {
        /// Start walking, or walk on.
        Walk = 1 "walk",
        /// Stop with the feet side by side: within two half-steps; from a stop in stride by one more half-step.
        Stop = 2 "stop",
        /// Stop in stride, the feet one before the other as they land.
        Hold = 3 "hold",
        /// Clear a latched fault; after a fall, return slowly to a stand once the robot is upright.
        Reset = 4 "reset",
        /// Step in place, turning if a turn is commanded, until another intent arrives.
        InPlace = 5 "in-place",
    }
}

impl Intent {
    /// Whether it ends the walk: [`Stop`](Intent::Stop) or [`Hold`](Intent::Hold). It is granted to every source.
    pub const fn is_stop(self) -> bool {
        matches!(self, Intent::Stop | Intent::Hold)
    }

    /// Whether it makes half-steps: [`Walk`](Intent::Walk) or [`InPlace`](Intent::InPlace).
    pub const fn steps(self) -> bool {
        matches!(self, Intent::Walk | Intent::InPlace)
    }
}
