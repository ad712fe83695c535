//! A request to push the simulated robot, and what became of it.

use model::Joint;
use nalgebra::Vector3;

use crate::code::codes;

/// A request to push the simulated robot: a constant force on a link's centre of mass that begins at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PushRequest {
    /// The pushed link, by the joint that carries it.
    pub link: Joint,
    /// Force times duration (N·s): ahead, to the left and up, as the trunk faces when it begins.
    pub impulse: Vector3<f64>,
    /// How long it lasts (s).
    pub duration: f64,
}

/// What became of a request to push.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PushReply {
    /// Whether the robot is pushed, or why not.
    pub outcome: PushOutcome,
    /// When the push begins (s), since the plant's start; the present time if there is none.
    pub start: f64,
}

codes! {
    /// Whether the robot is pushed, or why not.
    PushOutcome {
        /// It is pushed.
        Begun = 0 "pushed",
        /// The message is no push.
        Invalid = 1 "a push needs a link with a body, a finite impulse and a duration",
        /// It is too strong, too long or too short.
        OutOfRange = 2 "a push must last 1 ms to 10 s and have at most 10000 N·s",
        /// As many others act as may.
        TooMany = 3 "too many pushes act at the same time",
        /// Another program computes the physics, and its robot has no body for the link.
        NoSuchLink = 4 "the engine that computes the physics has no such link",
    }
}
