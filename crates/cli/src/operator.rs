//! The operator of a walk: sends a script's requests ahead of time, and hears what became of them.
//!
//! Such requests carry no age limit: all of them are on their way before the first is due, so that nobody needs to speak
//! any more, and in lockstep the walk depends on nothing but its inputs.

use std::collections::VecDeque;

use runtime::Rate;
use wire::{AskError, OperatorEnd, Reply, Request, Waiting};

use crate::failure::Failure;
use crate::script::Step;

/// Sends requests with the tick at which they are due, as many ahead as may be unanswered at a time.
pub struct Operator {
    end: OperatorEnd,
    to_send: VecDeque<Request>,
    /// In the order in which they are due.
    unanswered: VecDeque<(Request, Waiting)>,
}

impl Operator {
    /// For the steps of a script that begins at tick 0.
    pub fn new(end: OperatorEnd, steps: &[Step], rate: Rate) -> Self {
        let due = |step: &Step| Request { not_before: step.tick(rate), ..step.request };
        Self { end, to_send: steps.iter().map(due).collect(), unanswered: VecDeque::new() }
    }

    /// Sends what may be sent now.
    ///
    /// # Errors
    /// The controller cannot be reached.
    pub fn send(&mut self) -> Result<(), Failure> {
        while let Some(request) = self.to_send.front() {
            match self.end.requests.send(&request.into()) {
                Ok(waiting) => self.unanswered.push_back((*request, waiting)),
                Err(AskError::TooMany { .. }) => break,
                Err(error) => return Err(error.into()),
            }
            self.to_send.pop_front();
        }
        Ok(())
    }

    /// The next request that was answered, with its reply.
    pub fn next_reply(&mut self) -> Option<(Request, Reply)> {
        let (_, waiting) = self.unanswered.front()?;
        match waiting.poll() {
            Ok(None) => None,
            Ok(Some(reply)) => {
                let (request, _) = self.unanswered.pop_front()?;
                reply.checked().ok().map(|reply| (request, reply))
            }
            // The controller has ended: it will answer none of them.
            Err(_) => {
                self.unanswered.clear();
                self.to_send.clear();
                None
            }
        }
    }
}
