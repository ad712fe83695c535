//! Requests that wait for the tick before which they must not take effect, and their replies.
//!
//! A stop waits for nothing: it overtakes all others, there is always room for it, and what was requested before it and
//! still waits is refused. A heartbeat overtakes requests that need an evaluation. A newer request of a source takes
//! the place of an older one that it overrides. Requests that have expired are refused, and those of operators that
//! have gone or no longer wait for the reply are dropped; a stop is carried out all the same.

use std::time::Duration;

use controller::Tick;
use interface::{Command, Intent, LatchedFault, Lifetime, Mode, Reason, Reply, Request, Source, Verdict};
use serde::{Deserialize, Serialize};
use wire::{MAX_UNANSWERED, ReplyMessage, RequestMessage};

use crate::entry::ControllerEvent;
use crate::recorder::Recorder;
use crate::request_bridge::{IncomingRequest, RequestBridge, RequestId};
use crate::valid_request::{Invalid, valid};

/// Most requests that can wait for their tick, beside stops and heartbeats.
pub const CAPACITY: usize = 256;
/// Most stops that can wait; a later one takes the place of the last.
const STOPS: usize = 16;
/// Time between two looks for the next request of a script, and how many of them.
const SCRIPT_NAP: Duration = Duration::from_micros(100);
const SCRIPT_NAPS: u32 = 300_000;

/// Requests on their way to the controller.
pub struct RequestQueue {
    bridge: RequestBridge,
    /// Stops for at once, in the order of their arrival.
    stops: heapless::Vec<DueRequest, STOPS>,
    /// The newest heartbeat of each source.
    heartbeats: [Option<DueRequest>; Source::OPERATORS.len()],
    /// All others, earliest tick first; those for one tick in the order of their arrival.
    scheduled: heapless::Vec<DueRequest, CAPACITY>,
    /// The request that the controller evaluates.
    under_evaluation: Option<DueRequest>,
    /// The newest stop that was taken: older requests that arrive after it are refused.
    newest_stop: Option<RequestId>,
    /// The tick from which on the next request of a script may be due, which is not here yet.
    script_from: Option<u64>,
    /// The newest request of a script. Stops overtake others, so that older ones may arrive after it.
    newest_of_script: Option<RequestId>,
    /// The next tick.
    tick: u64,
    /// Whether a heartbeat was taken last: another request has its turn.
    took_heartbeat: bool,
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
    mode: Option<Mode>,
    latched: Option<LatchedFault>,
}

/// A request whose tick has come. Command arbitration counts its source as active from that tick on, not from when it
/// was sent.
#[derive(Clone, Copy, Debug)]
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
        let in_force = InForce { half_step: 0, command: Command::NOMINAL, intent: None, mode: None, latched: None };
        Self {
            bridge,
            stops: heapless::Vec::new(),
            heartbeats: [None; Source::OPERATORS.len()],
            scheduled: heapless::Vec::new(),
            under_evaluation: None,
            newest_stop: None,
            script_from: None,
            newest_of_script: None,
            tick: 0,
            took_heartbeat: false,
            in_force,
            tally: Tally::default(),
        }
    }

    /// Takes in all requests that have arrived, refuses at once those that can never be granted, and drops those of
    /// operators that have gone.
    pub fn collect(&mut self, recorder: &mut Recorder<ControllerEvent>) {
        for _ in 0..self.bridge.receive() {
            let Some(request) = self.bridge.next_request() else { break };
            recorder.push(request.event());
            self.schedule(request, recorder);
        }
        while let Some(id) = self.bridge.next_abandoned() {
            self.scheduled.retain(|waiting| waiting.id != id);
            let is_abandoned = |heartbeat: &Option<DueRequest>| heartbeat.is_some_and(|heartbeat| heartbeat.id == id);
            self.heartbeats.iter_mut().filter(|heartbeat| is_abandoned(heartbeat)).for_each(|place| *place = None);
        }
    }

    fn schedule(&mut self, IncomingRequest { id, message }: IncomingRequest, recorder: &mut Recorder<ControllerEvent>) {
        let request = match valid(&message) {
            Ok(request) => request,
            Err(Invalid { reason, place }) => {
                self.tally.count(Verdict::Refused);
                let refusal = Reply { place, ..self.in_force.refused(message.id, reason) };
                return self.reply(id, &refusal, recorder);
            }
        };
        if request.source == Source::Script
            && request.lifetime == Lifetime::Latched
            && self.newest_of_script.is_none_or(|newest| newest.is_before(id))
        {
            self.newest_of_script = Some(id);
            self.script_from = (message.present & RequestMessage::MORE != 0).then_some(request.not_before);
        }
        let due = DueRequest { id, request };
        let is_due = request.not_before <= self.tick;
        if is_due && request.is_stop() {
            if self.stops.is_full()
                && let Some(last) = self.stops.pop()
            {
                self.refuse(last.id, last.request.id, Reason::Superseded, recorder);
            }
            // There is room now.
            let _ = self.stops.push(due);
        } else if is_due && self.newest_stop.is_some_and(|stop| id.is_before(stop)) {
            self.refuse(id, request.id, Reason::Superseded, recorder);
        } else if is_due && request.is_empty() {
            if let Some(older) = self.heartbeats[place(request.source)].replace(due) {
                // Heartbeats are not counted.
                let refusal = self.in_force.refused(older.request.id, Reason::Superseded);
                self.reply(older.id, &refusal, recorder);
            }
        } else {
            if is_due {
                self.supersede(&request, recorder);
            }
            let at = self.scheduled.partition_point(|waiting| waiting.request.not_before <= request.not_before);
            if self.scheduled.insert(at, due).is_err() {
                self.refuse(id, request.id, Reason::QueueFull, recorder);
            }
        }
    }

    /// In lockstep: waits until the requests of a script have arrived that may be due at a tick, so that it does not
    /// matter how fast they are sent.
    pub fn await_script(
        &mut self,
        tick: u64,
        is_interrupted: impl Fn() -> bool,
        recorder: &mut Recorder<ControllerEvent>,
    ) {
        let mut naps = 0;
        while self.bridge.is_inline() && self.lacks_script(tick) && naps < SCRIPT_NAPS && !is_interrupted() {
            std::thread::sleep(SCRIPT_NAP);
            naps += 1;
            self.collect(recorder);
        }
        if naps == SCRIPT_NAPS {
            // Its sender has gone, or is halted.
            self.script_from = None;
        }
    }

    /// Whether a request of a script may be due that has not arrived, and whose sender can send it: he has no more
    /// unanswered ones than he may.
    fn lacks_script(&self, tick: u64) -> bool {
        let is_scripted = |waiting: &&DueRequest| {
            waiting.request.source == Source::Script && waiting.request.lifetime == Lifetime::Latched
        };
        let waiting = self.stops.iter().chain(&self.scheduled).chain(&self.under_evaluation);
        self.script_from.is_some_and(|from| from <= tick) && waiting.filter(is_scripted).count() < MAX_UNANSWERED
    }

    /// Refuses the waiting requests that a newer one of the same source overrides.
    fn supersede(&mut self, newer: &Request, recorder: &mut Recorder<ControllerEvent>) {
        let tick = self.tick;
        let overridden = |older: &Request| older.not_before <= tick && older.is_overridden_by(newer);
        while let Some(at) = self.scheduled.iter().position(|waiting| overridden(&waiting.request)) {
            let older = self.scheduled.remove(at);
            self.refuse(older.id, older.request.id, Reason::Superseded, recorder);
        }
    }

    /// Takes out the request that is due at a tick: a stop, else a heartbeat, else the one that has waited longest of
    /// those that have not expired.
    ///
    /// * `time_ns` – the time of `CLOCK_MONOTONIC` (ns)
    /// * `urgent_only` – only a stop or a heartbeat
    pub fn due(
        &mut self,
        tick: u64,
        time_ns: u64,
        urgent_only: bool,
        recorder: &mut Recorder<ControllerEvent>,
    ) -> Option<DueRequest> {
        self.tick = tick;
        if let Some(stop) = self.due_stop(recorder) {
            return Some(stop);
        }
        self.refuse_expired(time_ns, recorder);
        let is_due = self.scheduled.first().is_some_and(|first| first.request.not_before <= tick);
        if !(self.took_heartbeat && is_due && !urgent_only)
            && let Some(heartbeat) = self.heartbeats.iter_mut().find_map(Option::take)
        {
            self.took_heartbeat = true;
            return Some(heartbeat);
        }
        self.took_heartbeat = false;
        (is_due && !urgent_only).then(|| self.scheduled.remove(0))
    }

    /// Refuses the requests that have expired before the first one that is due and has not.
    fn refuse_expired(&mut self, time_ns: u64, recorder: &mut Recorder<ControllerEvent>) {
        let is_expired = |due: &DueRequest| due.request.has_expired(time_ns);
        while self.scheduled.first().is_some_and(|first| first.request.not_before <= self.tick && is_expired(first)) {
            let expired = self.scheduled.remove(0);
            self.refuse(expired.id, expired.request.id, Reason::Expired, recorder);
        }
        for place in 0..self.heartbeats.len() {
            if let Some(expired) = self.heartbeats[place].take_if(|heartbeat| is_expired(heartbeat)) {
                // Heartbeats are not counted.
                let refusal = self.in_force.refused(expired.request.id, Reason::Expired);
                self.reply(expired.id, &refusal, recorder);
            }
        }
    }

    /// Takes out a stop that is due, and refuses everything that was to take effect before it.
    fn due_stop(&mut self, recorder: &mut Recorder<ControllerEvent>) -> Option<DueRequest> {
        let due = self.scheduled.partition_point(|waiting| waiting.request.not_before <= self.tick);
        let (stop, older) = if self.stops.is_empty() {
            let at = self.scheduled[..due].iter().position(|waiting| waiting.request.is_stop())?;
            (self.scheduled.remove(at), at)
        } else {
            let stop = self.stops.remove(0);
            (stop, self.scheduled[..due].iter().filter(|waiting| waiting.id.is_before(stop.id)).count())
        };
        self.newest_stop = Some(stop.id);
        for _ in 0..older {
            let waiting = self.scheduled.remove(0);
            self.refuse(waiting.id, waiting.request.id, Reason::Superseded, recorder);
        }
        Some(stop)
    }

    /// Sends the replies of a tick, and remembers what is in force.
    ///
    /// * `submitted` – the request that was submitted before the tick
    pub fn answer(&mut self, submitted: Option<DueRequest>, tick: &Tick, recorder: &mut Recorder<ControllerEvent>) {
        self.in_force.half_step = tick.report.half_step.index;
        self.in_force.command = tick.command;
        self.in_force.mode = Some(tick.report.mode);
        self.in_force.latched = tick.latched;
        if let (Some(refusal), Some(superseded)) = (&tick.superseded, self.under_evaluation) {
            self.under_evaluation = None;
            self.decided(superseded, refusal, recorder);
        }
        match (submitted, &tick.reply) {
            (Some(submitted), Some(reply)) => self.decided(submitted, reply, recorder),
            (Some(submitted), None) => self.under_evaluation = Some(submitted),
            (None, Some(reply)) => {
                if let Some(evaluated) = self.under_evaluation.take() {
                    self.decided(evaluated, reply, recorder);
                }
            }
            (None, None) => {}
        }
    }

    fn decided(&mut self, due: DueRequest, reply: &Reply, recorder: &mut Recorder<ControllerEvent>) {
        self.in_force.intent = reply.intent;
        if due.id == RequestId::LOOP {
            return;
        }
        if !due.request.is_empty() {
            self.tally.count(reply.verdict);
        }
        self.reply(due.id, &Reply { id: due.request.id, ..*reply }, recorder);
    }

    /// Refuses all requests that still wait, because the controller ends. Returns the tally of the others.
    pub fn close(self, recorder: &mut Recorder<ControllerEvent>) -> Tally {
        let (mut io, unread) = self.bridge.close();
        let mut unread = unread.into_iter();
        let waiting = self.stops.iter().chain(self.heartbeats.iter().flatten()).chain(&self.scheduled);
        let waiting = waiting.chain(&self.under_evaluation).map(|waiting| (waiting.id, waiting.request.id));
        let mut refused: Vec<(RequestId, u64)> = waiting.collect();
        io.receive();
        while let Some(request) = unread.next().or_else(|| io.next_request()) {
            recorder.push(request.event());
            refused.push((request.id, request.message.id));
        }
        for (id, of_sender) in refused {
            let refusal = ReplyMessage::from(&self.in_force.refused(of_sender, Reason::ShuttingDown));
            io.reply(id, &refusal);
            recorder.push(ControllerEvent::Reply(id.number(), refusal));
        }
        self.tally
    }

    /// Refuses a request, which has the number `of_sender` for its operator.
    fn refuse(&mut self, id: RequestId, of_sender: u64, reason: Reason, recorder: &mut Recorder<ControllerEvent>) {
        self.tally.count(Verdict::Refused);
        let refusal = self.in_force.refused(of_sender, reason);
        self.reply(id, &refusal, recorder);
    }

    fn reply(&mut self, id: RequestId, reply: &Reply, recorder: &mut Recorder<ControllerEvent>) {
        let message = ReplyMessage::from(reply);
        self.bridge.reply(id, message);
        recorder.push(ControllerEvent::Reply(id.number(), message));
    }
}

/// Where the heartbeat of a source is kept.
fn place(source: Source) -> usize {
    Source::OPERATORS.iter().position(|&other| other == source).unwrap_or(0)
}

impl InForce {
    /// A refusal of a request with a number of its sender's, which leaves everything in force.
    fn refused(&self, of_sender: u64, reason: Reason) -> Reply {
        let Self { half_step, command, intent, mode, latched } = *self;
        Reply { id: of_sender, mode, latched, ..Reply::refused(reason, half_step, command, intent) }
    }
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
