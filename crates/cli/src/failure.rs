//! How a command ends: fine, not fine, or with a failure that says why.

use std::fmt::{self, Display};
use std::process::ExitCode;

/// How a command that did what it was told came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All is well.
    Fine,
    /// It was done, but the answer is no: the robot fell, a request was refused.
    NotFine,
}

/// Why a command could not do what it was told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Whether what a person wrote is to blame: a file, an option.
    pub bad_input: bool,
    /// For the person.
    pub text: String,
}

impl Failure {
    /// Something went wrong on the way.
    pub fn new(text: impl Display) -> Self {
        Self { bad_input: false, text: text.to_string() }
    }

    /// What a person wrote cannot be right.
    pub fn bad_input(text: impl Display) -> Self {
        Self { bad_input: true, text: text.to_string() }
    }

    /// What the program exits with.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(if self.bad_input { 2 } else { 1 })
    }
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Fine => ExitCode::SUCCESS,
            Outcome::NotFine => ExitCode::FAILURE,
        }
    }
}

impl Outcome {
    /// Fine if it is.
    pub fn fine_if(fine: bool) -> Self {
        if fine { Outcome::Fine } else { Outcome::NotFine }
    }
}

impl Display for Failure {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(&self.text)
    }
}

impl From<wire::ConnectError> for Failure {
    fn from(error: wire::ConnectError) -> Self {
        Self { bad_input: matches!(error, wire::ConnectError::BadName { .. }), text: error.to_string() }
    }
}

impl From<wire::AskError> for Failure {
    fn from(error: wire::AskError) -> Self {
        Self::new(error)
    }
}

impl From<wire::WireFault> for Failure {
    fn from(fault: wire::WireFault) -> Self {
        Self::new(fault)
    }
}

impl From<record::RecordError> for Failure {
    fn from(error: record::RecordError) -> Self {
        use record::RecordError::{NotMcap, Nothing, OtherVersion};
        Self {
            bad_input: matches!(error, Nothing { .. } | NotMcap { .. } | OtherVersion { .. }),
            text: error.to_string(),
        }
    }
}
