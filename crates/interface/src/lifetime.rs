//! How long a request stays in effect.

use crate::code::codes;

/// Shortest command timeout that a controller may have by default (s): streams without a timeout of their own send
/// several heartbeats within it.
pub const COMMAND_TIMEOUT_MIN: f64 = 0.1;
/// Longest command timeout (s): a robot that walks on for longer without its source is unattended. Longer ones are cut
/// to it.
pub const COMMAND_TIMEOUT_MAX: f64 = 60.0;

codes! {
    /// How long a request stays in effect.
    Lifetime {
        /// Until another request replaces it: a single command.
        Latched = 0 "until replaced",
        /// While its source keeps sending: an element of a stream. With it the source takes control authority; when it
        /// sends nothing for longer than the command timeout, the robot stops. An empty request is a heartbeat.
        Streamed = 1 "while its source keeps sending",
        /// The end of a stream: from now on everything the source requested is latched. May be empty.
        Release = 2 "released by its source",
    }
}
