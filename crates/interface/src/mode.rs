//! What the controller is doing.

use crate::code::codes;

codes! {
    /// What the controller is doing.
    Mode {
        /// Half-step after half-step.
        Walking = 0 "walking",
        /// Standing on both feet, in stride.
        Holding = 1 "holding",
        /// The robot has fallen; no joint moves until a reset.
        Fallen = 2 "fallen",
        /// On both feet: the weight shifts to the first support foot, or the joints return to a stand after a reset.
        Starting = 3 "starting",
        /// Standing on both feet, side by side.
        Standing = 4 "standing",
        /// The last half-steps before a stand.
        Stopping = 5 "stopping",
        /// Standing until a reset because of a latched fault.
        Faulted = 6 "faulted",
        /// Half-steps without progress.
        InPlace = 7 "in place",
    }
}
