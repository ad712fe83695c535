//! The inbox: requests that wait for their tick, and their answers.

use controller::{Asked, TickReport};
use serde::{Deserialize, Serialize};
use wire::{Granted, Reason, Reply, ReplyMessage, Verdict};

use crate::clerk::{Clerk, Letter, LetterId};
use crate::exchange;
use crate::record::{ControllerNews, Record};

/// How many requests may wait for their tick.
pub const CAPACITY: usize = 256;

/// Requests on their way to the controller, earliest tick first; of one tick, first come first served.
pub struct Inbox {
    clerk: Clerk,
    waiting: heapless::Vec<Waiting, CAPACITY>,
    /// What a refused request is told to be in force.
    in_force: (u64, Granted),
    tally: Tally,
}

struct Waiting {
    not_before: u64,
    due: Due,
}

/// A request whose tick has come. Its source is heard then, not when it was sent.
pub struct Due {
    /// Which letter asks.
    pub id: LetterId,
    /// What is asked.
    pub asked: Asked,
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
    /// Empty, for the letters that a clerk brings.
    pub fn new(clerk: Clerk) -> Self {
        let granted = Granted { turn: 0.0, speed: 1.0, extension: 0.0, intent: None };
        Self { clerk, waiting: heapless::Vec::new(), in_force: (0, granted), tally: Tally::default() }
    }

    /// Takes in what has come, and refuses at once what cannot be granted whatever happens.
    pub fn collect(&mut self, record: &mut Record<ControllerNews>) {
        while let Some(letter) = self.clerk.next_letter() {
            record.push(letter.news());
            self.take(letter, record);
        }
    }

    fn take(&mut self, Letter { id, message }: Letter, record: &mut Record<ControllerNews>) {
        let (not_before, asked) = match exchange::request::for_controller(&message) {
            Ok(asked) => asked,
            Err(reason) => return self.refuse(id, reason, record),
        };
        let place = self.waiting.partition_point(|waiting| waiting.not_before <= not_before);
        if self.waiting.insert(place, Waiting { not_before, due: Due { id, asked } }).is_err() {
            self.refuse(id, Reason::QueueFull, record);
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
            self.reply(due.id, &reply, record);
        }
    }

    /// Refuses what still waits, because the controller ends. Gives the tally of what was asked in time.
    pub fn close(self, record: &mut Record<ControllerNews>) -> Tally {
        let (effect_half_step, granted) = self.in_force;
        let refusal = ReplyMessage::from(&Reply::refused(Reason::ShuttingDown, effect_half_step, granted));
        let (mut counter, unread) = self.clerk.close();
        let mut unread = unread.into_iter();
        let mut refused: Vec<LetterId> = self.waiting.iter().map(|waiting| waiting.due.id).collect();
        while let Some(letter) = unread.next().or_else(|| counter.next_letter()) {
            record.push(letter.news());
            refused.push(letter.id);
        }
        for id in refused {
            counter.reply(id, &refusal);
            record.push(ControllerNews::Reply(id.number(), refusal));
        }
        self.tally
    }

    fn refuse(&mut self, id: LetterId, reason: Reason, record: &mut Record<ControllerNews>) {
        let (effect_half_step, granted) = self.in_force;
        self.tally.count(Verdict::Refused);
        self.reply(id, &Reply::refused(reason, effect_half_step, granted), record);
    }

    fn reply(&mut self, id: LetterId, reply: &Reply, record: &mut Record<ControllerNews>) {
        let message = ReplyMessage::from(reply);
        self.clerk.reply(id, message);
        record.push(ControllerNews::Reply(id.number(), message));
    }
}

impl Letter {
    fn news(&self) -> ControllerNews {
        ControllerNews::Request(self.id.number(), self.message)
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
