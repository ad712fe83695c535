//! What operators asked for in a recorded run, and what the controller replied.

use std::collections::BTreeMap;

use dialogue::reply_text::reply_text;
use interface::{Request, Verdict};
use scene::{RunNote, rounded};
use wire::{ReplyMessage, RequestMessage};

/// Pairs requests with their replies.
#[derive(Default)]
pub(crate) struct RecordedRequests {
    asked: BTreeMap<u32, Request>,
    /// The replies so far, in words.
    pub(crate) notes: Vec<RunNote>,
}

impl RecordedRequests {
    /// A request of this number was received.
    pub(crate) fn asked(&mut self, number: u32, message: &RequestMessage) {
        self.asked.extend(message.checked().ok().map(|request| (number, request)));
    }

    /// It was replied to. Heartbeats of streams are no news.
    pub(crate) fn replied(&mut self, time: f64, number: u32, message: &ReplyMessage) {
        let (Some(request), Ok(reply)) = (self.asked.remove(&number), message.checked()) else { return };
        if request.is_empty() && reply.verdict != Verdict::Refused {
            return;
        }
        let text = format!("{}: {}", request.source, reply_text(&request, &reply));
        self.notes.push(RunNote { t: rounded([time])[0], kind: reply.verdict.text(), text });
    }
}
