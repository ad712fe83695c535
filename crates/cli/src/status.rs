//! How a command ended that did what it was asked to.

use std::process::ExitCode;

/// How a command ended that did what it was asked to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// All is well.
    Success,
    /// The answer is no: the robot fell, a request was refused, a replay differs.
    Failure,
}

impl Status {
    /// Success if the condition holds.
    pub fn success_if(holds: bool) -> Self {
        if holds { Status::Success } else { Status::Failure }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        match status {
            Status::Success => ExitCode::SUCCESS,
            Status::Failure => ExitCode::FAILURE,
        }
    }
}
