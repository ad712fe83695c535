//! Events: what is recorded, one kind a channel.

use wire::{LaidOut, Layout, MeasurementMessage, ReplyMessage, ReportMessage, RequestMessage, SetpointMessage};

use crate::{TickMessage, TruthMessage};

macro_rules! events {
    ($($(#[$doc:meta])* $channel:ident($message:ident) = $topic:literal,)+) => {
        /// One thing that happened.
        // Events are passed on one at a time, never stored in numbers: boxing the large ones would only cost.
        #[allow(clippy::large_enum_variant)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Event {
            $($(#[$doc])* $channel($message),)+
        }

        /// A kind of events.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Channel {
            $($(#[$doc])* $channel,)+
        }

        impl Channel {
            /// All of them.
            pub const ALL: &[Channel] = &[$(Channel::$channel),+];

            /// What it is called in a recording.
            pub const fn topic(self) -> &'static str {
                match self {
                    $(Channel::$channel => $topic,)+
                }
            }

            /// Of its messages.
            pub fn layout(self) -> Layout {
                match self {
                    $(Channel::$channel => $message::layout(),)+
                }
            }

            /// The event that these bytes are of; `None` if they are too many or too few.
            pub(crate) fn event(self, bytes: &[u8]) -> Option<Event> {
                match self {
                    $(Channel::$channel => $message::take(bytes).map(Event::$channel),)+
                }
            }
        }

        impl Event {
            /// Its kind.
            pub const fn channel(&self) -> Channel {
                match self {
                    $(Event::$channel(_) => Channel::$channel,)+
                }
            }

            /// Appends its bytes.
            pub(crate) fn put(&self, bytes: &mut Vec<u8>) {
                match self {
                    $(Event::$channel(message) => message.put(bytes),)+
                }
            }
        }
    };
}

events! {
    /// What an operator asked, as it came.
    Request(RequestMessage) = "/requests",
    /// What it was told.
    Reply(ReplyMessage) = "/replies",
    /// What the controller's loop did in a tick. Comes before what else there is of the tick.
    Tick(TickMessage) = "/ticks",
    /// What the controller went by.
    Measurement(MeasurementMessage) = "/measurements",
    /// What it gave the plant.
    Setpoint(SetpointMessage) = "/setpoints",
    /// What it told observers.
    Report(ReportMessage) = "/reports",
    /// What the simulated robot really was.
    Truth(TruthMessage) = "/truth",
}
