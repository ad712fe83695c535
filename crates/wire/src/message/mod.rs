//! The messages, one per file: `#[repr(C)]`, fixed size, no padding, no bytes that could be invalid.
//!
//! A message is what lies in shared memory: anyone can have written it, so it may be nonsense. The crate `interface`
//! has the value that it carries, without the suffix ([`SetpointMessage`] and [`Setpoint`](interface::Setpoint)):
//! `checked()` gives that value or says why it cannot, `new` or `From` write the message. Neither allocates nor panics.
//! A measurement is not checked here: the controller validates it, so that a faulty sensor becomes a fault in its
//! report.
//!
//! Any change of a layout gets a new `.vN` in the type name **and** a new [`PROTOCOL`](crate::PROTOCOL).

mod fault;
mod measurement;
mod reply;
mod report;
mod request;
mod setpoint;

use std::fmt::Debug;

use iceoryx2::prelude::ZeroCopySend;

pub use fault::MessageFault;
pub use measurement::MeasurementMessage;
pub use reply::ReplyMessage;
pub use report::ReportMessage;
pub use request::RequestMessage;
pub use setpoint::SetpointMessage;

/// The tick of a message that has not been written yet. No writer counts that far.
pub const NEVER_WRITTEN: u64 = u64::MAX;

/// A message of which only the newest counts. Sealed: the messages of this crate implement it, nobody else does.
pub trait Latest: ZeroCopySend + Copy + Debug + Send + 'static {
    /// The message that stands there before anything was written: its tick is [`NEVER_WRITTEN`].
    #[doc(hidden)]
    const EMPTY: Self;

    /// The writer's count of periods.
    fn tick(&self) -> u64;
}
