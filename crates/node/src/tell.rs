//! Messages to the person who started a process.
//!
//! They are events of `tracing` of their own target: the program decides what becomes of them. `halfstep` writes them
//! to stderr, or nowhere with `--quiet`. Loops never tell anything: the threads beside them do.

use std::fmt::Display;

use tracing::Level;

/// The target of all messages.
pub const TARGET: &str = "halfstep";

/// Tells something.
pub fn tell(text: impl Display) {
    tracing::info!(target: TARGET, "{text}");
}

/// Whether nobody wants to be told anything.
pub fn is_quiet() -> bool {
    !tracing::enabled!(target: TARGET, Level::INFO)
}
