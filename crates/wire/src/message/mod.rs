//! The messages, one per file: `#[repr(C)]`, fixed size, no padding, no bytes that could be invalid.
//!
//! A message is what lies in shared memory: anyone can have written it, so it may be nonsense. Each has a checked twin
//! without the suffix (`SetpointMessage` and [`Setpoint`]) that cannot be: `checked()` leads from one to the other or
//! says why not, `From` leads back. Checking neither allocates nor panics.
//!
//! Any change of a layout gets a new `.vN` in the type name **and** a new [`PROTOCOL`](crate::PROTOCOL).

mod code;
mod fault;
mod measurement;
mod reply;
mod report;
mod request;
mod setpoint;

use std::fmt::Debug;

use iceoryx2::prelude::ZeroCopySend;

pub use fault::MessageFault;
pub use measurement::{Measurement, MeasurementMessage};
pub use reply::{Bound, Granted, InCommand, Reason, Reply, ReplyMessage, Verdict};
pub use report::{Fault, Mode, Report, ReportMessage};
pub use request::{Intent, Lasting, Request, RequestMessage, Source};
pub use setpoint::{Setpoint, SetpointMessage};

/// The tick of a message that has not been written yet. No writer counts that far.
pub const NOTHING_YET: u64 = u64::MAX;

/// A message of which only the newest counts. Sealed: the messages of this crate implement it, nobody else does.
pub trait Newest: ZeroCopySend + Copy + Debug + Send + 'static {
    /// The message that stands there before anything was written: its tick is [`NOTHING_YET`].
    #[doc(hidden)]
    const NOTHING: Self;

    /// The writer's count of periods.
    fn tick(&self) -> u64;
}
