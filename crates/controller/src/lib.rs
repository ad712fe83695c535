//! What to do this tick: estimate, walk, limit, report.
//!
//! [`Controller::tick`] takes the period's length, the newest measurement and at most one request, and gives the setpoint
//! and a report. It never allocates, blocks, logs or fails: bad input becomes a [`Fault`] in the report, and the same
//! inputs give the same bits. There is no clock and no I/O here.

mod asked;
mod controller;
mod fault;
mod guard;
mod inquiry;
mod measurement;
mod mode;
mod parameters;
mod pattern;
mod report;
mod requests;
mod sources;
mod watch;

pub use asked::Asked;
pub use controller::Controller;
pub use fault::{Fault, Faults};
pub use guard::Guard;
pub use inquiry::{Inquiry, Ruling};
pub use measurement::Measurement;
pub use mode::{Intent, Mode};
pub use parameters::{Parameters, WatchParameters};
pub use pattern::{Compensation, Pattern};
pub use report::{AddedAngles, Answer, Refusal, Setpoint, TickReport};
pub(crate) use requests::Desk;
pub use sources::{AGE_LIMIT_MIN, Lasting, Outranked, Source, Sources, SourcesParameters};
