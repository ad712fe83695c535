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
mod flat_places;
mod measurement;
mod push;
mod reply;
mod report;
mod request;
mod setpoint;
mod true_pose;

use std::fmt::Debug;

use iceoryx2::prelude::ZeroCopySend;

pub use fault::MessageFault;
pub use measurement::MeasurementMessage;
pub use push::{PushReplyMessage, PushRequestMessage};
pub use reply::ReplyMessage;
pub use report::ReportMessage;
pub use request::RequestMessage;
pub use setpoint::SetpointMessage;
pub use true_pose::TruePoseMessage;

/// The tick of a message that has not been written yet. No writer counts that far.
pub const NEVER_WRITTEN: u64 = u64::MAX;

/// A message of which only the newest counts. Sealed: the messages of this crate implement it, nobody else does.
pub trait Latest: ZeroCopySend + Copy + Debug + Send + 'static {
    /// The message that stands there before anything was written: its tick is [`NEVER_WRITTEN`].
    #[doc(hidden)]
    const EMPTY: Self;

    /// The writer's count of periods.
    fn tick(&self) -> u64;

    /// When it was written, on `CLOCK_MONOTONIC` (ns).
    fn time_ns(&self) -> u64;
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;

    use super::*;
    use crate::WireLayout;

    /// Any bits of a message's length, with many numbers that are none.
    fn bytes_of<M: WireLayout>(words: &[u64]) -> Vec<u8> {
        let numbers = [f64::NAN, f64::INFINITY, -0.0, 1.0, 1e308, 0.0, f64::MIN_POSITIVE, -1.0].map(f64::to_bits);
        let word = |word: &u64| *numbers.get(*word as usize % 12).unwrap_or(word);
        let mut bytes: Vec<u8> =
            words.iter().cycle().map(word).flat_map(u64::to_le_bytes).take(M::layout().size).collect();
        bytes.resize(M::layout().size, 0);
        bytes
    }

    proptest! {
        #[test]
        fn any_bits_are_a_message_or_a_fault_with_a_name(words in vec(any::<u64>(), 1..120), cut in 0..2000_usize) {
            macro_rules! check {
                ($($message:ident),+) => {$(
                    let bytes = bytes_of::<$message>(&words);
                    let message = $message::decode(&bytes).expect("as long as its layout says");
                    if let Err(fault) = message.checked() {
                        assert!(!fault.to_string().is_empty());
                    }
                    let mut again = Vec::new();
                    message.encode(&mut again);
                    assert_eq!(again, bytes, "every bit is kept");
                    assert!($message::decode(&bytes[..cut.min(bytes.len() - 1)]).is_none());
                )+};
            }
            check!(SetpointMessage, ReportMessage, RequestMessage, ReplyMessage, PushRequestMessage, PushReplyMessage);
            let measurement = MeasurementMessage::decode(&bytes_of::<MeasurementMessage>(&words));
            measurement.expect("as long as its layout says").measurement();
        }
    }
}
