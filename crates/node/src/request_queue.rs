//! Requests that wait for the tick before which they must not take effect, and their replies.

use controller::Tick;
use interface::{Command, Intent, Lifetime, Reason, Reply, Request, Verdict};
use serde::{Deserialize, Serialize};
use wire::{MessageFault, ReplyMessage, RequestMessage};

use crate::entry::ControllerEvent;
use crate::recorder::Recorder;
use crate::request_bridge::{IncomingRequest, RequestBridge, RequestId};

/// Most requests that can wait for their tick.
pub const CAPACITY: usize = 256;

/// Requests on their way to the controller, earliest tick first; those for one tick in the order of their arrival.
pub struct RequestQueue {
    bridge: RequestBridge,
    scheduled: heapless::Vec<DueRequest, CAPACITY>,
    /// What is in force, for the reply to a request that is refused at once.
    in_force: InForce,
    tally: Tally,
}

/// What is in force after a tick.
#[derive(Clone, Copy)]
struct InForce {
    half_step: u64,
    command: Command,
    intent: Option<Intent>,
}

/// A request whose tick has come. Command arbitration counts its source as active from that tick on, not from when it
/// was sent.
pub struct DueRequest {
    /// Routes the reply back to the operator.
    pub id: RequestId,
    /// The request as the controller takes it.
    pub request: Request,
}

/// How many requests got which verdict. The heartbeats of a stream are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Requests granted as requested.
    pub accepted: u64,
    /// Requests granted as far as the limits allow.
    pub limited: u64,
    /// Requests not granted.
    pub refused: u64,
}

impl RequestQueue {
    /// An empty queue for the requests of a bridge.
    pub fn new(bridge: RequestBridge) -> Self {
        let in_force = InForce { half_step: 0, command: Command::NOMINAL, intent: None };
        Self { bridge, scheduled: heapless::Vec::new(), in_force, tally: Tally::default() }
    }

    /// Takes in all requests that have arrived, and refuses at once those that can never be granted.
    pub fn collect(&mut self, recorder: &mut Recorder<ControllerEvent>) {
        while let Some(request) = self.bridge.next_request() {
            recorder.push(request.event());
            self.schedule(request, recorder);
        }
    }

    fn schedule(&mut self, IncomingRequest { id, message }: IncomingRequest, recorder: &mut Recorder<ControllerEvent>) {
        let request = match valid(&message) {
            Ok(request) => request,
            Err(reason) => return self.refuse(id, reason, recorder),
        };
        let place = self.scheduled.partition_point(|scheduled| scheduled.request.not_before <= request.not_before);
        if self.scheduled.insert(place, DueRequest { id, request }).is_err() {
            self.refuse(id, Reason::QueueFull, recorder);
        }
    }

    /// Takes out the one request that is due at a tick and has waited longest for it.
    pub fn due(&mut self, tick: u64) -> Option<DueRequest> {
        let is_due = self.scheduled.first().is_some_and(|first| first.request.not_before <= tick);
        is_due.then(|| self.scheduled.remove(0))
    }

    /// Sends the tick's reply to a request, and remembers what is in force.
    pub fn answer(&mut self, due: Option<DueRequest>, tick: &Tick, recorder: &mut Recorder<ControllerEvent>) {
        self.in_force.half_step = tick.report.half_step.index;
        self.in_force.command = tick.command;
        if let (Some(due), Some(reply)) = (due, &tick.reply) {
            self.in_force.intent = reply.intent;
            if !due.request.is_empty() {
                self.tally.count(reply.verdict);
            }
            self.reply(due.id, reply, recorder);
        }
    }

    /// Refuses all requests that still wait, because the controller ends. Returns the tally of the others.
    pub fn close(self, recorder: &mut Recorder<ControllerEvent>) -> Tally {
        let refusal = ReplyMessage::from(&self.in_force.refused(Reason::ShuttingDown));
        let (mut io, unread) = self.bridge.close();
        let mut unread = unread.into_iter();
        let mut refused: Vec<RequestId> = self.scheduled.iter().map(|scheduled| scheduled.id).collect();
        while let Some(request) = unread.next().or_else(|| io.next_request()) {
            recorder.push(request.event());
            refused.push(request.id);
        }
        for id in refused {
            io.reply(id, &refusal);
            recorder.push(ControllerEvent::Reply(id.number(), refusal));
        }
        self.tally
    }

    fn refuse(&mut self, id: RequestId, reason: Reason, recorder: &mut Recorder<ControllerEvent>) {
        self.tally.count(Verdict::Refused);
        let refusal = self.in_force.refused(reason);
        self.reply(id, &refusal, recorder);
    }

    fn reply(&mut self, id: RequestId, reply: &Reply, recorder: &mut Recorder<ControllerEvent>) {
        let message = ReplyMessage::from(reply);
        self.bridge.reply(id, message);
        recorder.push(ControllerEvent::Reply(id.number(), message));
    }
}

impl InForce {
    /// A refusal that leaves everything in force.
    fn refused(&self, reason: Reason) -> Reply {
        Reply::refused(reason, self.half_step, self.command, self.intent)
    }
}

/// The request of a message.
///
/// # Errors
/// Why no controller of this version can grant it.
fn valid(message: &RequestMessage) -> Result<Request, Reason> {
    let request = message.checked().map_err(|fault| match fault {
        MessageFault::NotFinite { .. } => Reason::NotFinite,
        _ => Reason::UnknownCode,
    })?;
    // In a stream an empty request is a heartbeat or the end; by itself it is a mistake.
    if request.is_empty() && request.lifetime == Lifetime::Latched { Err(Reason::Empty) } else { Ok(request) }
}

impl IncomingRequest {
    fn event(&self) -> ControllerEvent {
        ControllerEvent::Request(self.id.number(), self.message)
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

#[cfg(test)]
mod tests {
    use interface::{GaitChange, Source};

    use super::*;

    #[test]
    fn an_empty_request_is_refused_unless_it_belongs_to_a_stream() {
        let empty = Request::new(Source::Console);
        assert_eq!(valid(&(&empty).into()), Err(Reason::Empty));
        for lifetime in [Lifetime::Streamed, Lifetime::Release] {
            let request = Request { lifetime, ..empty };
            assert_eq!(valid(&(&request).into()), Ok(request));
        }
    }

    #[test]
    fn a_request_that_is_not_finite_is_refused() {
        let gait = GaitChange { speed: Some(1.0), ..GaitChange::NONE };
        let request = Request { gait, ..Request::new(Source::Script) };
        let message = RequestMessage { speed: f64::NAN, ..RequestMessage::from(&request) };
        assert_eq!(valid(&message), Err(Reason::NotFinite));
    }
}
