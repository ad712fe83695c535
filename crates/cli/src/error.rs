//! Why a command could not do what it was asked to, as the user reads it.

use std::fmt::{self, Display};
use std::io;
use std::path::Path;
use std::process::ExitCode;

use serde::Serialize;

/// Why a command could not do what it was asked to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CliError {
    /// Whether the command line or an input file is wrong.
    bad_input: bool,
    /// What the user reads.
    #[serde(rename = "error")]
    text: String,
    /// What a child process has told already.
    #[serde(skip_serializing_if = "Option::is_none")]
    cause: Option<String>,
}

impl CliError {
    /// Something failed while the command ran.
    pub(crate) fn new(text: impl Display) -> Self {
        Self { bad_input: false, text: text.to_string(), cause: None }
    }

    /// The command line or an input file is wrong.
    pub(crate) fn bad_input(text: impl Display) -> Self {
        Self { bad_input: true, text: text.to_string(), cause: None }
    }

    /// The same error of a child process, which has told its own one.
    pub(crate) fn with_cause(self, cause: Option<String>) -> Self {
        Self { cause, ..self }
    }

    /// A file or folder cannot be read or written.
    pub(crate) fn file(path: &Path) -> impl Fn(io::Error) -> Self {
        move |error| Self::new(format!("{}: {error}", path.display()))
    }

    /// A file that the user names cannot be read.
    pub(crate) fn input_file(path: &Path) -> impl Fn(io::Error) -> Self {
        move |error| Self::bad_input(format!("{}: {error}", path.display()))
    }

    /// The exit code of the program: 2 for a wrong command line or input file, else 1.
    pub(crate) fn exit_code(&self) -> ExitCode {
        ExitCode::from(if self.bad_input { 2 } else { 1 })
    }
}

impl Display for CliError {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(&self.text)
    }
}

impl From<wire::ConnectError> for CliError {
    fn from(error: wire::ConnectError) -> Self {
        if matches!(error, wire::ConnectError::BadName { .. }) { Self::bad_input(error) } else { Self::new(error) }
    }
}

impl From<wire::RequestError> for CliError {
    fn from(error: wire::RequestError) -> Self {
        Self::new(error)
    }
}

impl From<wire::TransportError> for CliError {
    fn from(fault: wire::TransportError) -> Self {
        Self::new(fault)
    }
}

impl From<operator::OperatorError> for CliError {
    fn from(error: operator::OperatorError) -> Self {
        match error {
            operator::OperatorError::Connect(error) => error.into(),
            error => Self::new(error),
        }
    }
}

impl From<node::NodeError> for CliError {
    fn from(error: node::NodeError) -> Self {
        match error {
            node::NodeError::Recording(error) => error.into(),
            node::NodeError::Configuration(_) => Self::bad_input(error),
            error => Self::new(error),
        }
    }
}

impl From<node::interrupt::ListenError> for CliError {
    fn from(error: node::interrupt::ListenError) -> Self {
        Self::new(error)
    }
}

impl From<node::engine::EnvironmentError> for CliError {
    fn from(error: node::engine::EnvironmentError) -> Self {
        Self::new(error)
    }
}

impl From<interchange::import::ImportError> for CliError {
    fn from(error: interchange::import::ImportError) -> Self {
        Self::bad_input(error)
    }
}

impl From<robots::ImportedRobotError> for CliError {
    fn from(error: robots::ImportedRobotError) -> Self {
        match error {
            robots::ImportedRobotError::Import(error) => error.into(),
            error => Self::bad_input(error),
        }
    }
}

impl From<plots::run_log::CsvError> for CliError {
    fn from(error: plots::run_log::CsvError) -> Self {
        Self::new(error)
    }
}

impl From<record::RecordError> for CliError {
    fn from(error: record::RecordError) -> Self {
        use record::RecordError::{Io, NotMcap, Nothing, OtherVersion, UnknownCompression, Unreadable, WrongSize};
        let is_missing = matches!(&error, Io { source, .. } if source.kind() == io::ErrorKind::NotFound);
        let is_input = matches!(
            error,
            Nothing { .. }
                | NotMcap { .. }
                | OtherVersion { .. }
                | UnknownCompression { .. }
                | Unreadable { .. }
                | WrongSize { .. }
        );
        if is_input || is_missing { Self::bad_input(error) } else { Self::new(error) }
    }
}

impl From<view::ViewError> for CliError {
    fn from(error: view::ViewError) -> Self {
        match error {
            view::ViewError::Record(error) => error.into(),
            view::ViewError::Robot(_) | view::ViewError::Lacks { .. } => Self::bad_input(error),
            error => Self::new(error),
        }
    }
}
