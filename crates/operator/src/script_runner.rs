//! Runs a script: sends its requests ahead of time, and collects the replies.
//!
//! These requests stay in effect until changed: all of them are on their way before the first is due, so that no
//! heartbeat is needed, and in lockstep the walk depends on nothing but its inputs.

use interface::{Rate, Reply, Request};
use std::collections::VecDeque;

use wire::{OperatorPorts, PendingReply, ReplyMessage, RequestError, RequestMessage};

use crate::OperatorError;
use dialogue::script::TimedRequest;

/// Sends requests with the tick at which they are due, as many ahead as may be without a reply at a time.
pub struct ScriptRunner {
    operator: OperatorPorts,
    to_send: VecDeque<Request>,
    /// Requests that were sent and not yet taken by [`next_reply`](Self::next_reply), in the order in which they are
    /// due.
    sent: VecDeque<(Request, ReplyState)>,
}

/// The reply to a request.
enum ReplyState {
    Pending(PendingReply),
    Received(ReplyMessage),
    /// The controller has ended.
    Lost,
}

impl ScriptRunner {
    /// A runner for the requests of a script that begins at tick 0.
    pub fn new(operator: OperatorPorts, script: &[TimedRequest], rate: Rate) -> Self {
        let due = |timed: &TimedRequest| Request { not_before: timed.tick(rate), ..timed.request };
        let mut to_send: Vec<Request> = script.iter().map(due).collect();
        // Each tells that another one follows which is due no earlier.
        to_send.sort_by_key(|request| request.not_before);
        Self { operator, to_send: to_send.into(), sent: VecDeque::new() }
    }

    /// Sends as many requests as may be without a reply. In lockstep the controller waits for the next one.
    ///
    /// # Errors
    /// The controller cannot be reached.
    pub fn send(&mut self) -> Result<(), OperatorError> {
        // A reply makes room, also one to a later request than others that still wait.
        self.sent.iter_mut().for_each(|(_, answer)| answer.update());
        while let Some(request) = self.to_send.front() {
            let mut message = RequestMessage::from(request);
            if self.to_send.len() > 1 {
                message.present |= RequestMessage::MORE;
            }
            match self.operator.requests.send(&message) {
                Ok(pending) => self.sent.push_back((*request, ReplyState::Pending(pending))),
                Err(RequestError::TooMany { .. }) => break,
                Err(error) => return Err(error.into()),
            }
            self.to_send.pop_front();
        }
        Ok(())
    }

    /// The next request that has a reply, with its reply.
    pub fn next_reply(&mut self) -> Option<(Request, Reply)> {
        let (request, answer) = self.sent.front_mut()?;
        answer.update();
        match answer {
            ReplyState::Pending(_) => None,
            ReplyState::Received(reply) => {
                let answered = reply.checked().ok().map(|reply| (*request, reply));
                self.sent.pop_front();
                answered
            }
            // It will answer no request.
            ReplyState::Lost => {
                self.sent.clear();
                self.to_send.clear();
                None
            }
        }
    }
}

impl ReplyState {
    /// Takes the reply if it has arrived, which makes room for another request.
    fn update(&mut self) {
        let ReplyState::Pending(pending) = self else { return };
        match pending.poll() {
            Ok(None) => {}
            Ok(Some(reply)) => *self = ReplyState::Received(reply),
            Err(_) => *self = ReplyState::Lost,
        }
    }
}
