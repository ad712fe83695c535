//! Benchmarks of computing time, latency and jitter, each against a reference in the same run.
//!
//! * [`compute`]: inverse dynamics, a step of the plant, a tick of the controller, planning.
//! * [`exchange`]: a round trip of measurement and setpoint between two processes, against plain iceoryx2 and a ring in
//!   shared memory.
//! * [`control_latency`]: a running controller from outside, from measurement to setpoint and from request to effect.
//! * [`jitter`]: how late a loop wakes up, against cyclictest or a bare loop.
//! * [`observed_jitter`]: the controller's loop while it is recorded, observed and shown, or beside spectators that are
//!   stopped, against the same loop by itself.
//!
//! All are measured in interleaved rounds, so that other load on the machine affects all alike, and reported as
//! [`BenchReport`]. Absolute times depend on the machine; the result is in the ratios within one run.

pub mod compute;
pub mod control_latency;
pub mod cyclictest;
mod error;
pub mod exchange;
mod histograms;
pub mod jitter;
pub mod machine;
pub mod observed_jitter;
pub mod page;
mod page_viewer;
mod raw_iceoryx2;
mod raw_ring;
pub mod report;
pub mod series;

pub use error::BenchError;
pub use machine::Machine;
pub use report::{BenchReport, Ratio, RatioVerdict};
pub use series::{Reduction, Series};
