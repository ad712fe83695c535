//! When things happen: deadlines, and a journal that never holds up the loop.
//!
//! The only crate that asks for the time. It knows nothing of robots and depends on no other crate of the workspace.

mod journal;
mod period;

pub use journal::{Journal, JournalEnd};
pub use period::{Period, now_ns};
