//! Why a robot could not be driven from a terminal.

use std::io;

use wire::{ConnectError, TransportError};

/// Why a robot could not be driven from a terminal.
#[derive(Debug, thiserror::Error)]
pub enum TeleopError {
    /// Input or output is no terminal.
    #[error(
        "{0} is no terminal: teleop reads keys and draws a screen; use `halfstep send` for single requests, or \
         `halfstep stream` for those of a program"
    )]
    NoTerminal(&'static str),
    /// The terminal cannot be used.
    #[error("the terminal: {0}")]
    Terminal(#[from] io::Error),
    /// The terminal is gone.
    #[error("the terminal is gone; the robot stops")]
    TerminalGone,
    /// There is no connection to the controller.
    #[error(transparent)]
    Connect(#[from] ConnectError),
    /// Shared memory failed.
    #[error(transparent)]
    Wire(#[from] TransportError),
}
