//! Why a recording could not be written or read.

use std::io;
use std::path::{Path, PathBuf};

/// Why a recording could not be written or read. That its end is missing is no error: see
/// [`Recording::cut`](crate::Recording::cut).
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The operating system says no.
    #[error("{file}: {source}", file = file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file cannot be written any further.
    #[error("{file}: cannot record: {cause}", file = file.display())]
    Unwritable {
        /// The file.
        file: PathBuf,
        /// What MCAP's writer says.
        cause: String,
    },
    /// The file is something else.
    #[error("{file}: not an MCAP file", file = file.display())]
    NotMcap {
        /// The file.
        file: PathBuf,
    },
    /// A folder without a recording.
    #[error("{folder}: holds no recording; it must hold {names}, as `halfstep walk --out` writes them", folder = folder.display())]
    Nothing {
        /// The folder.
        folder: PathBuf,
        /// What would be read.
        names: String,
    },
    /// A recording of another version of Halfstep, or somebody else's.
    #[error(
        "{file}: {topic} was written by another version: its messages are `{found}`, those of this version `{expected}`",
        file = file.display()
    )]
    OtherVersion {
        /// The file.
        file: PathBuf,
        /// Of the messages.
        topic: String,
        /// What they are according to the file, as one line.
        found: String,
        /// What they must be.
        expected: String,
    },
    /// A message has too few or too many bytes.
    #[error("{file}: message {number} of {topic} has {size} bytes, which its schema does not allow", file = file.display())]
    WrongSize {
        /// The file.
        file: PathBuf,
        /// Of the message.
        topic: String,
        /// Its number.
        number: u32,
        /// [bytes]
        size: usize,
    },
}

impl RecordError {
    pub(crate) fn io(file: &Path) -> impl Fn(io::Error) -> Self {
        let file = file.to_owned();
        move |source| RecordError::Io { file: file.clone(), source }
    }

    /// What MCAP's writer says, about a file.
    pub(crate) fn unwritable(file: &Path, cause: mcap::McapError) -> Self {
        match cause {
            mcap::McapError::Io(source) => RecordError::Io { file: file.to_owned(), source },
            cause => RecordError::Unwritable { file: file.to_owned(), cause: cause.to_string() },
        }
    }
}
