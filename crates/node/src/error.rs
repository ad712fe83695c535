//! Why a process of the pair could not do its work.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use record::RecordError;

use crate::cycle::PeerSilent;
use crate::engine::{EngineError, EnvironmentError};

/// Why a process of the pair could not do its work.
#[derive(Debug, thiserror::Error)]
pub enum NodeError {
    /// Configuration files cannot be used; every mistake, one per line.
    #[error("{0}")]
    Configuration(String),
    /// A file or folder cannot be read or written.
    #[error("{}: {cause}", path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// Why the operating system refused.
        cause: std::io::Error,
    },
    /// The operating system refused another thread.
    #[error("cannot start a thread: {0}")]
    Thread(std::io::Error),
    /// A recording cannot be read or written.
    #[error(transparent)]
    Recording(#[from] RecordError),
    /// The other side of a lockstep run went silent.
    #[error(transparent)]
    PeerSilent(#[from] PeerSilent),
    /// The physics engine failed.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// The physics engine's Python environment is not there and cannot be made.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

impl NodeError {
    /// Configuration files cannot be used.
    pub(crate) fn configuration(mistakes: impl Display) -> Self {
        Self::Configuration(mistakes.to_string())
    }

    /// A file or folder cannot be read or written.
    pub(crate) fn file(path: &Path) -> impl Fn(std::io::Error) -> Self {
        move |cause| Self::File { path: path.to_owned(), cause }
    }
}
