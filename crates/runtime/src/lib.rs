//! Timing of loops: deadlines, real-time scheduling, and a journal that never blocks the loop.
//!
//! Knows nothing of robots, and depends on no other crate of the workspace.

mod journal;
mod period;
mod scheduling;
mod system;

pub use journal::{Journal, JournalEnd};
pub use period::{Period, Wake, now_ns};
pub use scheduling::{Granted, Refusal, Scheduling, keep_off};
pub use system::Usage;
