//! A request of an operator.

use crate::{GaitChange, Intent, Lifetime, Source};

/// A request of an operator. It is atomic: it takes effect as a whole or not at all. The one exception is a stop, which
/// takes effect before the gait parameters of the same request are evaluated. From a source that is outranked, only the
/// stop is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// The controller's tick before which it must not take effect; 0 is at once.
    pub not_before: u64,
    /// Where it comes from.
    pub source: Source,
    /// Gait parameters to change.
    pub gait: GaitChange,
    /// What the robot is to do; `None` leaves the intent as it is.
    pub intent: Option<Intent>,
    /// How long it stays in effect.
    pub lifetime: Lifetime,
    /// Command timeout of a streamed request (s); `None` is the controller's own. Other lifetimes ignore it.
    pub timeout: Option<f64>,
}

impl Request {
    /// An empty, latched request for at once, to be filled in.
    pub const fn new(source: Source) -> Self {
        Self { not_before: 0, source, gait: GaitChange::NONE, intent: None, lifetime: Lifetime::Latched, timeout: None }
    }

    /// Whether it changes nothing: a heartbeat, or the end of a stream.
    pub fn is_empty(&self) -> bool {
        self.gait == GaitChange::NONE && self.intent.is_none()
    }

    /// Whether it ends the walk, which is granted to every source.
    pub fn is_stop(&self) -> bool {
        self.intent.is_some_and(Intent::is_stop)
    }

    /// Whether it need not wait for the request that is under evaluation: a stop or a heartbeat.
    pub fn is_urgent(&self) -> bool {
        self.is_stop() || self.is_empty()
    }
}
