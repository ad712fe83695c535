//! Why a recording could not be written or read.

use std::io;
use std::path::{Path, PathBuf};

/// Why a recording could not be written or read. A missing end is not an error: see
/// [`Recording::cut`](crate::Recording::cut).
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The operating system refused.
    #[error("{file}: {source}", file = file.display())]
    Io {
        /// Path of the file.
        file: PathBuf,
        /// The reason given by the system.
        source: io::Error,
    },
    /// The file cannot be written any further.
    #[error("{file}: cannot record: {cause}", file = file.display())]
    Unwritable {
        /// Path of the file.
        file: PathBuf,
        /// The reason given by the MCAP writer.
        cause: String,
    },
    /// Another process writes to the file.
    #[error("{file}: another process is recording into it; choose another folder (--out)", file = file.display())]
    InUse {
        /// Path of the file.
        file: PathBuf,
    },
    /// The file is not an MCAP file.
    #[error("{file}: not an MCAP file", file = file.display())]
    NotMcap {
        /// Path of the file.
        file: PathBuf,
    },
    /// Nothing of the run can be read from the file.
    #[error("{file}: holds nothing of a run: {cause}", file = file.display())]
    Unreadable {
        /// Path of the file.
        file: PathBuf,
        /// Where it is truncated or damaged.
        cause: String,
    },
    /// The file's chunks are compressed in a way that cannot be read.
    #[error(
        "{file}: is compressed with `{compression}`; lz4 and zstd can be read, for others unpack it first with \
         `mcap decompress`",
        file = file.display()
    )]
    UnknownCompression {
        /// Path of the file.
        file: PathBuf,
        /// MCAP's name of the compression.
        compression: String,
    },
    /// The folder holds no recording.
    #[error(
        "{folder}: holds no recording; it must hold {names}, as `halfstep walk --out` writes them",
        folder = folder.display()
    )]
    Nothing {
        /// Path of the folder.
        folder: PathBuf,
        /// Names of the files that would be read.
        names: String,
    },
    /// The recording was written by another version of Halfstep, or by another program.
    #[error(
        "{file}: {topic} was written by another version: its messages are `{found}`, \
         those of this version `{expected}`",
        file = file.display()
    )]
    OtherVersion {
        /// Path of the file.
        file: PathBuf,
        /// Topic of the messages.
        topic: String,
        /// Type of the messages according to the file, in one line.
        found: String,
        /// Type that the messages must have.
        expected: String,
    },
    /// A message has too few or too many bytes.
    #[error(
        "{file}: message {number} of {topic} has {size} bytes, which its schema does not allow",
        file = file.display()
    )]
    WrongSize {
        /// Path of the file.
        file: PathBuf,
        /// Topic of the message.
        topic: String,
        /// Number of the message, MCAP's `sequence`.
        number: u32,
        /// Size of the message (bytes).
        size: usize,
    },
}

impl RecordError {
    /// An error of the operating system for a file.
    pub(crate) fn io(file: &Path) -> impl Fn(io::Error) -> Self {
        let file = file.to_owned();
        move |source| RecordError::Io { file: file.clone(), source }
    }

    /// An error of the MCAP writer for a file.
    pub(crate) fn unwritable(file: &Path, cause: mcap::McapError) -> Self {
        match cause {
            mcap::McapError::Io(source) => RecordError::Io { file: file.to_owned(), source },
            cause => RecordError::Unwritable { file: file.to_owned(), cause: cause.to_string() },
        }
    }
}
