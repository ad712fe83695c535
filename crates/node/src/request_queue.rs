//! Requests from shared memory on their way to the controller, and its replies on their way back.
//!
//! Which request is due in a tick is decided by [`RequestSchedule`]. Here requests are taken in, those are refused that
//! can never be granted, those of operators that have gone or no longer wait for the reply are dropped, and in lockstep
//! the loop waits for a script whose next request may be due.

use std::time::Duration;

use controller::{DueRequest, RequestAnswer, RequestId, RequestSchedule, Tick};
use interface::{Lifetime, Reason, Reply, Source, Verdict};
use serde::{Deserialize, Serialize};
use wire::{MAX_UNANSWERED, ReplyMessage, RequestMessage};

use crate::entry::ControllerEvent;
use crate::recorder::Recorder;
use crate::request_bridge::{IncomingRequest, RequestBridge};
use crate::valid_request::{Invalid, valid};

/// Most requests that can wait for their tick, beside stops and heartbeats.
pub const CAPACITY: usize = RequestSchedule::CAPACITY;
/// Time between two looks for the next request of a script, and how many of them.
const SCRIPT_NAP: Duration = Duration::from_micros(100);
const SCRIPT_NAPS: u32 = 300_000;

/// Requests on their way to the controller.
pub struct RequestQueue {
    bridge: RequestBridge,
    schedule: RequestSchedule,
    /// The tick from which on the next request of a script may be due, which is not here yet.
    script_from: Option<u64>,
    /// The newest request of a script. Stops overtake others, so that older ones may arrive after it.
    newest_of_script: Option<RequestId>,
    tally: Tally,
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
        let schedule = RequestSchedule::default();
        Self { bridge, schedule, script_from: None, newest_of_script: None, tally: Tally::default() }
    }

    /// Takes in all requests that have arrived, refuses at once those that can never be granted, and drops those of
    /// operators that have gone.
    pub fn collect(&mut self, recorder: &mut Recorder<ControllerEvent>) {
        for _ in 0..self.bridge.receive() {
            let Some(request) = self.bridge.next_request() else { break };
            recorder.push(request.event());
            self.take_in(request, recorder);
        }
        while let Some(id) = self.bridge.next_abandoned() {
            self.schedule.drop_abandoned(id);
        }
    }

    fn take_in(&mut self, IncomingRequest { id, message }: IncomingRequest, recorder: &mut Recorder<ControllerEvent>) {
        let Self { bridge, schedule, tally, .. } = self;
        let mut answer = |answer: RequestAnswer| send(&answer, bridge, tally, recorder);
        let request = match valid(&message) {
            Ok(request) => request,
            Err(Invalid { reason, place }) => {
                let reply = Reply { place, ..schedule.refusal(message.id, reason) };
                return answer(RequestAnswer { id, reply, is_heartbeat: false });
            }
        };
        if request.source == Source::Script
            && request.lifetime == Lifetime::Latched
            && self.newest_of_script.is_none_or(|newest| newest.is_before(id))
        {
            self.newest_of_script = Some(id);
            self.script_from = (message.present & RequestMessage::MORE != 0).then_some(request.not_before);
        }
        schedule.add(DueRequest { id, request }, &mut answer);
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
        self.script_from.is_some_and(|from| from <= tick)
            && self.schedule.waiting().filter(is_scripted).count() < MAX_UNANSWERED
    }

    /// Takes out the request that is due at a tick, as [`RequestSchedule::due`].
    pub fn due(
        &mut self,
        tick: u64,
        time_ns: u64,
        urgent_only: bool,
        recorder: &mut Recorder<ControllerEvent>,
    ) -> Option<DueRequest> {
        let Self { bridge, schedule, tally, .. } = self;
        schedule.due(tick, time_ns, urgent_only, &mut |answer| send(&answer, bridge, tally, recorder))
    }

    /// Sends the replies of a tick, and remembers what is in force.
    ///
    /// * `submitted` – the request that was submitted before the tick
    pub fn answer(&mut self, submitted: Option<DueRequest>, tick: &Tick, recorder: &mut Recorder<ControllerEvent>) {
        let Self { bridge, schedule, tally, .. } = self;
        schedule.conclude(submitted, tick, &mut |answer| send(&answer, bridge, tally, recorder));
    }

    /// Refuses all requests that still wait, because the controller ends. Returns the tally of the others.
    pub fn close(self, recorder: &mut Recorder<ControllerEvent>) -> Tally {
        let (mut io, unread) = self.bridge.close();
        let mut unread = unread.into_iter();
        let waiting = self.schedule.waiting().map(|waiting| (waiting.id, waiting.request.id));
        let mut refused: Vec<(RequestId, u64)> = waiting.collect();
        io.receive();
        while let Some(request) = unread.next().or_else(|| io.next_request()) {
            recorder.push(request.event());
            refused.push((request.id, request.message.id));
        }
        for (id, of_sender) in refused {
            let refusal = ReplyMessage::from(&self.schedule.refusal(of_sender, Reason::ShuttingDown));
            io.reply(id, &refusal);
            recorder.push(ControllerEvent::Reply(id.number(), refusal));
        }
        self.tally
    }
}

/// Sends a reply, records and counts it.
fn send(
    answer: &RequestAnswer,
    bridge: &mut RequestBridge,
    tally: &mut Tally,
    recorder: &mut Recorder<ControllerEvent>,
) {
    if !answer.is_heartbeat {
        tally.count(answer.reply.verdict);
    }
    let message = ReplyMessage::from(&answer.reply);
    bridge.reply(answer.id, message);
    recorder.push(ControllerEvent::Reply(answer.id.number(), message));
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
