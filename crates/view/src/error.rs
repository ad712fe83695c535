//! Why nothing can be shown.

use std::net::SocketAddr;

use record::RecordError;

/// Why nothing can be shown.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// The address cannot be listened on.
    #[error("cannot listen on {address}: {cause}; choose another address (--listen 127.0.0.1:0 takes any free port)")]
    Listen {
        /// The address.
        address: SocketAddr,
        /// The reason as given by the operating system.
        cause: std::io::Error,
    },
    /// The operating system refuses something that a server needs.
    #[error("cannot {what}: {cause}")]
    System {
        /// What it refuses.
        what: &'static str,
        /// The reason.
        cause: std::io::Error,
    },
    /// A recording cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A recording's robot is wrong.
    #[error("{0}")]
    Robot(String),
    /// A recording lacks something.
    #[error("{run}: lacks {what}")]
    Lacks {
        /// The recording.
        run: String,
        /// What it lacks.
        what: String,
    },
}
