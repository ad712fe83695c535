//! Whether the robot can still be kept from falling.

use crate::code::codes;

codes! {
    /// What it takes to keep the robot from falling, as estimated from the measured divergent component of motion and
    /// from the tilt of the body. In the terms of Koolen et al. (2012), "Capturability-based analysis and control of
    /// legged locomotion": whether it is capturable without a step, by steps, or not.
    Capturability {
        /// Nothing: the ankles balance it while it walks on as planned, or stands.
        ByAnkles = 1 "balanced",
        /// Steps off their planned places and times.
        BySteps = 2 "catching itself",
        /// More than its steps can do: it will most likely fall.
        Lost = 3 "falling",
    }
}
