//! A request whose time has come: what is asked, by whom, and for how long.

use crate::{Intent, Lasting, Source};

/// What is asked, in its envelope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    /// Of the gait.
    pub request: gait::Request,
    /// Of the controller.
    pub intent: Option<Intent>,
    /// By whom.
    pub source: Source,
    /// For how long.
    pub lasting: Lasting,
}

impl Asked {
    /// Whether it asks for nothing: a sign of life of its source, or the end of its stream.
    pub fn is_empty(&self) -> bool {
        self.request == gait::Request::default() && self.intent.is_none()
    }

    /// Whether it asks for a stand, which is granted whoever asks.
    pub fn is_stop(&self) -> bool {
        matches!(self.intent, Some(Intent::Stop | Intent::Hold))
    }
}
