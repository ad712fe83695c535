//! Messages to the person who started a process, on stderr.
//!
//! Nobody may read them: the pipe is closed, the disk full. A message that cannot be written is lost, and nothing else
//! happens; `eprintln!` would panic.

use std::fmt::Display;
use std::io::Write;

/// Writes a line to stderr, or loses it.
pub fn tell(text: impl Display) {
    // In one piece, so that lines of several processes do not mix.
    let line = format!("{text}\n");
    let _ = std::io::stderr().lock().write_all(line.as_bytes());
}
