//! The inbox: requests that wait for their tick, and their answers.

use controller::{Asked, TickReport};
use serde::{Deserialize, Serialize};
use wire::{Answer, Granted, Reason, Reply, ReplyMessage, RequestMessage, RequestServer, Verdict};

use crate::exchange;
use crate::record::{ControllerNews, Record};

/// How many requests may wait for their tick.
pub const CAPACITY: usize = 256;

/// Requests on their way to the controller, earliest tick first; of one tick, first come first served.
pub struct Inbox {
    server: RequestServer,
    waiting: heapless::Vec<Waiting, CAPACITY>,
    /// What a refused request is told to be in force.
    in_force: (u64, Granted),
    tally: Tally,
    /// How many requests have come.
    count: u32,
}

struct Waiting {
    not_before: u64,
    due: Due,
}

/// A request whose tick has come. Its source is heard then, not when it was sent.
pub struct Due {
    /// Requests count from 1 in the order in which they came.
    pub number: u32,
    /// What is asked.
    pub asked: Asked,
    answer: Answer,
}

/// How many requests were answered how. A stream's signs of life are none.
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
        Self { server, waiting: heapless::Vec::new(), in_force: (0, granted), tally: Tally::default(), count: 0 }
    }

    /// Takes in what has come, and refuses at once what cannot be granted whatever happens.
    pub fn collect(&mut self, record: &mut Record<ControllerNews>) {
        // An operator whose memory cannot be reached has gone; the next look finds the others.
        while let Ok(Some((message, answer))) = self.server.next_request() {
            self.count += 1;
            record.push(ControllerNews::Request(self.count, message));
            self.take(&message, answer, record);
        }
    }

    fn take(&mut self, message: &RequestMessage, answer: Answer, record: &mut Record<ControllerNews>) {
        let number = self.count;
        let (not_before, asked) = match exchange::request::for_controller(message) {
            Ok(asked) => asked,
            Err(reason) => return self.refuse(number, answer, reason, record),
        };
        let place = self.waiting.partition_point(|waiting| waiting.not_before <= not_before);
        let waiting = Waiting { not_before, due: Due { number, asked, answer } };
        if let Err(waiting) = self.waiting.insert(place, waiting) {
            self.refuse(number, waiting.due.answer, Reason::QueueFull, record);
        }
    }

    /// The one request that is due at a tick and has waited longest for it.
    pub fn due(&mut self, tick: u64) -> Option<Due> {
        let is_due = self.waiting.first().is_some_and(|first| first.not_before <= tick);
        is_due.then(|| self.waiting.remove(0).due)
    }

    /// Answers a request with what the tick made of it, and notes what is in force.
    pub fn answer(&mut self, due: Option<Due>, report: &TickReport, record: &mut Record<ControllerNews>) {
        let (half_step, granted) = &mut self.in_force;
        *half_step = report.half_step.index;
        granted.turn = report.command.turn;
        granted.speed = report.command.speed;
        granted.extension = report.command.extension;
        if let (Some(due), Some(answer)) = (due, &report.answer) {
            let reply = exchange::reply::reply(answer);
            granted.intent = reply.granted.intent;
            if !due.asked.is_empty() {
                self.tally.count(reply.verdict);
            }
            // Whether the operator is still there to hear it changes nothing.
            let message = ReplyMessage::from(&reply);
            due.answer.reply(&message);
            record.push(ControllerNews::Reply(due.number, message));
        }
    }

    /// Refuses what still waits, because the controller ends. Gives the tally of what was asked in time.
    pub fn close(mut self, record: &mut Record<ControllerNews>) -> Tally {
        let tally = self.tally;
        self.collect(record);
        while let Some(Waiting { due, .. }) = self.waiting.pop() {
            self.refuse(due.number, due.answer, Reason::ShuttingDown, record);
        }
        tally
    }

    fn refuse(&mut self, number: u32, answer: Answer, reason: Reason, record: &mut Record<ControllerNews>) {
        let (effect_half_step, granted) = self.in_force;
        self.tally.count(Verdict::Refused);
        let message = ReplyMessage::from(&Reply::refused(reason, effect_half_step, granted));
        answer.reply(&message);
        record.push(ControllerNews::Reply(number, message));
    }
}

impl Tally {
    fn count(&mut self, verdict: Verdict) {
        match verdict {
            Verdict::Accepted => self.accepted += 1,
            Verdict::Limited => self.limited += 1,
            Verdict::Refused => self.refused += 1,
        }
    }
}
