//! The inbox: requests that wait for their tick, and their answers.

use controller::{Intent, TickReport};
use serde::{Deserialize, Serialize};
use wire::{Answer, Granted, Reason, Reply, RequestMessage, RequestServer, Verdict};

use crate::exchange;

/// How many requests may wait for their tick.
pub const CAPACITY: usize = 256;

/// Requests on their way to the controller, earliest tick first; of one tick, first come first served.
pub struct Inbox {
    server: RequestServer,
    waiting: heapless::Vec<Waiting, CAPACITY>,
    /// What a refused request is told to be in force.
    in_force: (u64, Granted),
    tally: Tally,
}

struct Waiting {
    not_before: u64,
    asked: Asked,
}

/// A request whose tick has come.
pub struct Asked {
    /// For the gait.
    pub request: gait::Request,
    /// For the controller.
    pub intent: Option<Intent>,
    answer: Answer,
}

/// How many requests were answered how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// As asked.
    pub accepted: u64,
    /// As near to it as the limits allow.
    pub limited: u64,
    /// Not at all.
    pub refused: u64,
}

impl Inbox {
    /// Empty, for the requests that come to `server`.
    pub fn new(server: RequestServer) -> Self {
        let granted = Granted { turn: 0.0, speed: 1.0, extension: 0.0, intent: None };
        Self { server, waiting: heapless::Vec::new(), in_force: (0, granted), tally: Tally::default() }
    }

    /// Takes in what has come, and refuses at once what cannot be granted whatever happens.
    pub fn collect(&mut self) {
        // An operator whose memory cannot be reached has gone; the next look finds the others.
        while let Ok(Some((message, answer))) = self.server.next_request() {
            self.take(&message, answer);
        }
    }

    fn take(&mut self, message: &RequestMessage, answer: Answer) {
        let (not_before, (request, intent)) = match exchange::request::for_controller(message) {
            Ok(asked) => asked,
            Err(reason) => return self.refuse(answer, reason),
        };
        let place = self.waiting.partition_point(|waiting| waiting.not_before <= not_before);
        let waiting = Waiting { not_before, asked: Asked { request, intent, answer } };
        if let Err(waiting) = self.waiting.insert(place, waiting) {
            self.refuse(waiting.asked.answer, Reason::QueueFull);
        }
    }

    /// The one request that is due at a tick and has waited longest for it.
    pub fn due(&mut self, tick: u64) -> Option<Asked> {
        let is_due = self.waiting.first().is_some_and(|first| first.not_before <= tick);
        is_due.then(|| self.waiting.remove(0).asked)
    }

    /// Answers a request with what the tick made of it, and notes what is in force.
    pub fn answer(&mut self, asked: Option<Asked>, report: &TickReport) {
        let (half_step, granted) = &mut self.in_force;
        *half_step = report.half_step.index;
        granted.turn = report.command.turn;
        granted.speed = report.command.speed;
        granted.extension = report.command.extension;
        if let (Some(asked), Some(answer)) = (asked, &report.answer) {
            let reply = exchange::reply::reply(answer);
            granted.intent = reply.granted.intent;
            self.reply(asked.answer, &reply);
        }
    }

    /// Refuses what still waits, because the controller ends. Gives the tally of what was asked in time.
    pub fn close(mut self) -> Tally {
        let tally = self.tally;
        self.collect();
        while let Some(waiting) = self.waiting.pop() {
            self.refuse(waiting.asked.answer, Reason::ShuttingDown);
        }
        tally
    }

    fn refuse(&mut self, answer: Answer, reason: Reason) {
        let (effect_half_step, granted) = self.in_force;
        self.reply(answer, &Reply { verdict: Verdict::Refused, reason, effect_half_step, granted });
    }

    fn reply(&mut self, answer: Answer, reply: &Reply) {
        match reply.verdict {
            Verdict::Accepted => self.tally.accepted += 1,
            Verdict::Limited => self.tally.limited += 1,
            Verdict::Refused => self.tally.refused += 1,
        }
        // Whether the operator is still there to hear it changes nothing.
        answer.reply(&reply.into());
    }
}
