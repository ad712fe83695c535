//! Why an engine cannot be used.

use std::time::Duration;

use super::laid_floor::EDGE_MIN;
use super::message::{PROTOCOL, SETPOINT_LEN, STATE_LEN};

/// Why an engine cannot be used. The engine itself may have printed more on stderr.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// The engine's program cannot be started.
    #[error("cannot start the engine `{program}`: {cause}")]
    Start {
        /// Name of the program.
        program: String,
        /// Why the operating system refused.
        cause: std::io::Error,
    },
    /// The floor has more pieces than an external engine can have bodies.
    #[error(
        "the floor has tiles or cells of {edge} m: other engines get a body for each, {EDGE_MIN} m or more would be \
         right"
    )]
    FineFloor {
        /// Edge of the smallest tiles or cells (m).
        edge: f64,
    },
    /// The engine's process has ended.
    #[error("the engine has ended: {0}")]
    Ended(std::io::Error),
    /// The engine runs but does not answer.
    #[error("the engine has not answered for {} s", .0.as_secs())]
    Silent(Duration),
    /// The operating system refused a thread to read from the engine.
    #[error("cannot start a thread: {0}")]
    Thread(std::io::Error),
    /// The engine's protocol is a different one.
    #[error(
        "engine protocol mismatch: expected protocol {PROTOCOL} with records of {SETPOINT_LEN} and {STATE_LEN} \
         numbers, got {0}"
    )]
    Mismatch(String),
    /// The engine's simulation has diverged.
    #[error("the engine's state after {time} s is not finite, or its orientation is invalid")]
    NotFinite {
        /// Simulated time since the start (s).
        time: f64,
    },
}
