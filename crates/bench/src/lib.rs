//! How fast it is, beside others in the same run.
//!
//! * [`compute`]: what a configuration, a step, a tick, a plan cost.
//! * [`exchange`]: a round trip of measurement and setpoint between two processes, beside iceoryx2 by itself and a ring in
//!   shared memory.
//! * [`jitter`]: how late a loop wakes up, beside cyclictest or a bare loop.
//!
//! All of it is measured in rounds that take turns, so that what else the machine does meets everybody alike, and told as
//! [`Findings`]. Times of a machine say little; what counts are ratios within one run.

pub mod compute;
pub mod cyclictest;
pub mod exchange;
pub mod findings;
pub mod jitter;
pub mod machine;
mod raw_iceoryx2;
mod raw_ring;
pub mod series;

pub use findings::{Findings, Ratio};
pub use machine::Machine;
pub use series::{Over, Series};

/// Why something could not be measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: {cause}")]
pub struct BenchError {
    /// What was tried.
    pub what: &'static str,
    /// In the words of whoever refused.
    pub cause: String,
}

impl BenchError {
    /// With the cause in its own words.
    pub fn new(what: &'static str, cause: impl std::fmt::Display) -> Self {
        Self { what, cause: cause.to_string() }
    }
}
