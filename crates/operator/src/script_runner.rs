//! Runs a script: sends its requests ahead of time, and collects the replies.
//!
//! These requests stay in effect until changed: all of them are on their way before the first is due, so that no
//! heartbeat is needed, and in lockstep the walk depends on nothing but its inputs.

use interface::{Reply, Request};
use std::collections::VecDeque;

use runtime::Rate;
use wire::{OperatorPorts, PendingReply, RequestError};

use crate::OperatorError;
use crate::script::TimedRequest;

/// Sends requests with the tick at which they are due, as many ahead as may be without a reply at a time.
pub struct ScriptRunner {
    operator: OperatorPorts,
    to_send: VecDeque<Request>,
    /// Requests without a reply, in the order in which they are due.
    unanswered: VecDeque<(Request, PendingReply)>,
}

impl ScriptRunner {
    /// A runner for the requests of a script that begins at tick 0.
    pub fn new(operator: OperatorPorts, script: &[TimedRequest], rate: Rate) -> Self {
        let due = |timed: &TimedRequest| Request { not_before: timed.tick(rate), ..timed.request };
        Self { operator, to_send: script.iter().map(due).collect(), unanswered: VecDeque::new() }
    }

    /// Sends as many requests as may be without a reply.
    ///
    /// # Errors
    /// The controller cannot be reached.
    pub fn send(&mut self) -> Result<(), OperatorError> {
        while let Some(request) = self.to_send.front() {
            match self.operator.requests.send(&request.into()) {
                Ok(waiting) => self.unanswered.push_back((*request, waiting)),
                Err(RequestError::TooMany { .. }) => break,
                Err(error) => return Err(error.into()),
            }
            self.to_send.pop_front();
        }
        Ok(())
    }

    /// The next request that has a reply, with its reply.
    pub fn next_reply(&mut self) -> Option<(Request, Reply)> {
        let (_, waiting) = self.unanswered.front()?;
        match waiting.poll() {
            Ok(None) => None,
            Ok(Some(reply)) => {
                let (request, _) = self.unanswered.pop_front()?;
                reply.checked().ok().map(|reply| (request, reply))
            }
            // The controller has ended: it will answer no request.
            Err(_) => {
                self.unanswered.clear();
                self.to_send.clear();
                None
            }
        }
    }
}
