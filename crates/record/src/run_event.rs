//! Events of a run: what is recorded, one kind per channel.

use wire::{Layout, MeasurementMessage, ReplyMessage, ReportMessage, RequestMessage, SetpointMessage, WireLayout};

use crate::{PushMessage, TickMessage, TruthMessage};

macro_rules! events {
    ($($(#[$doc:meta])* $channel:ident($message:ident) = $topic:literal,)+) => {
        /// An event of a run.
        // Events are passed on one at a time and never stored: boxing the large ones would only cost time.
        #[allow(clippy::large_enum_variant)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum RunEvent {
            $($(#[$doc])* $channel($message),)+
        }

        /// A channel of a recording: one kind of events.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Channel {
            $($(#[$doc])* $channel,)+
        }

        impl Channel {
            /// All channels.
            pub const ALL: &[Channel] = &[$(Channel::$channel),+];

            /// Topic of the channel in a recording.
            pub const fn topic(self) -> &'static str {
                match self {
                    $(Channel::$channel => $topic,)+
                }
            }

            /// Layout of the channel's messages.
            pub fn layout(self) -> Layout {
                match self {
                    $(Channel::$channel => $message::layout(),)+
                }
            }

            /// The event with these bytes; `None` if they are too many or too few.
            pub(crate) fn decode(self, bytes: &[u8]) -> Option<RunEvent> {
                match self {
                    $(Channel::$channel => $message::decode(bytes).map(RunEvent::$channel),)+
                }
            }
        }

        impl RunEvent {
            /// Channel of the event.
            pub const fn channel(&self) -> Channel {
                match self {
                    $(RunEvent::$channel(_) => Channel::$channel,)+
                }
            }

            /// Appends the bytes of the event.
            pub(crate) fn encode(&self, bytes: &mut Vec<u8>) {
                match self {
                    $(RunEvent::$channel(message) => message.encode(bytes),)+
                }
            }
        }
    };
}

events! {
    /// A request of an operator, as received.
    Request(RequestMessage) = "/requests",
    /// The reply to a request.
    Reply(ReplyMessage) = "/replies",
    /// The inputs of a tick of the controller beside the measurement. Comes before the other events of the tick.
    Tick(TickMessage) = "/ticks",
    /// The measurement that the controller used.
    Measurement(MeasurementMessage) = "/measurements",
    /// The setpoint sent to the plant.
    Setpoint(SetpointMessage) = "/setpoints",
    /// The report published to observers.
    Report(ReportMessage) = "/reports",
    /// The true state of the simulated robot.
    Truth(TruthMessage) = "/truth",
    /// A push that was asked for while the plant ran.
    Push(PushMessage) = "/pushes",
}
