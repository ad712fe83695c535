//! Requests that wait for the tick before which they must not take effect, and which of them is due.
//!
//! A stop waits for nothing: it overtakes all others, there is always room for it, and what was requested before it and
//! still waits is refused. A heartbeat overtakes requests that need an evaluation. A newer request of a source takes
//! the place of an older one that it overrides. Requests that have expired are refused; a stop is carried out all the
//! same.

use interface::{Command, Intent, LatchedFault, Mode, Reason, Reply, Request, Source};

use crate::Tick;

/// Most stops that can wait; a later one takes the place of the last.
const STOPS: usize = 16;

/// Requests on their way to the controller.
#[derive(Clone, Debug)]
pub struct RequestSchedule {
    /// Stops for at once, in the order of their arrival.
    stops: heapless::Vec<DueRequest, STOPS>,
    /// The newest heartbeat of each source.
    heartbeats: [Option<DueRequest>; Source::OPERATORS.len()],
    /// All others, earliest tick first; those for one tick in the order of their arrival.
    scheduled: heapless::Vec<DueRequest, { RequestSchedule::CAPACITY }>,
    /// The request that the controller evaluates.
    under_evaluation: Option<DueRequest>,
    /// The newest stop that was taken: older requests that arrive after it are refused.
    newest_stop: Option<RequestId>,
    /// The next tick.
    tick: u64,
    /// Whether a heartbeat was taken last: another request has its turn.
    took_heartbeat: bool,
    /// What is in force, for the reply to a request that is refused at once.
    in_force: InForce,
}

/// Identifies a request within one run of the controller: they are counted from 1 in the order of their arrival.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct RequestId(u32);

/// A request whose tick has come. Command arbitration counts its source as active from that tick on, not from when it
/// was sent.
#[derive(Clone, Copy, Debug)]
pub struct DueRequest {
    /// Routes the reply back to the operator.
    pub id: RequestId,
    /// The request as the controller takes it.
    pub request: Request,
}

/// The reply to a request, on its way back.
#[derive(Clone, Copy, Debug)]
pub struct RequestAnswer {
    /// Whose reply it is.
    pub id: RequestId,
    /// The reply, with the number that the sender gave to its request.
    pub reply: Reply,
    /// Whether it answers a sign of life only.
    pub is_heartbeat: bool,
}

/// What is in force after a tick.
#[derive(Clone, Copy, Debug)]
struct InForce {
    half_step: u64,
    command: Command,
    intent: Option<Intent>,
    mode: Option<Mode>,
    latched: Option<LatchedFault>,
}

impl RequestId {
    /// Requests of the loop itself; their replies go nowhere.
    pub const LOOP: Self = Self(u32::MAX);

    /// The number in recordings.
    pub const fn number(self) -> u32 {
        self.0
    }

    /// That of the request that arrives next.
    #[must_use]
    pub const fn next(self) -> Self {
        Self(self.0 + 1)
    }

    /// Whether its request arrived before that of another one.
    pub const fn is_before(self, other: Self) -> bool {
        self.0 < other.0
    }
}

impl Default for RequestSchedule {
    fn default() -> Self {
        Self {
            stops: heapless::Vec::new(),
            heartbeats: [None; Source::OPERATORS.len()],
            scheduled: heapless::Vec::new(),
            under_evaluation: None,
            newest_stop: None,
            tick: 0,
            took_heartbeat: false,
            in_force: InForce { half_step: 0, command: Command::NOMINAL, intent: None, mode: None, latched: None },
        }
    }
}

impl RequestSchedule {
    /// Most requests that can wait for their tick, beside stops and heartbeats.
    pub const CAPACITY: usize = 256;

    /// Takes in a request, and gives the replies to those whose place it takes, or to itself, to `answer`.
    pub fn add(&mut self, due: DueRequest, answer: &mut impl FnMut(RequestAnswer)) {
        let DueRequest { id, request } = due;
        let is_due = request.not_before <= self.tick;
        if is_due && request.is_stop() {
            if self.stops.is_full()
                && let Some(last) = self.stops.pop()
            {
                self.refuse(&last, Reason::Superseded, answer);
            }
            // There is room now.
            let _ = self.stops.push(due);
        } else if is_due && self.newest_stop.is_some_and(|stop| id.is_before(stop)) {
            self.refuse(&due, Reason::Superseded, answer);
        } else if is_due && request.is_empty() {
            if let Some(older) = self.heartbeats[place(request.source)].replace(due) {
                self.refuse(&older, Reason::Superseded, answer);
            }
        } else {
            if is_due {
                self.supersede(&request, answer);
            }
            let at = self.scheduled.partition_point(|waiting| waiting.request.not_before <= request.not_before);
            if self.scheduled.insert(at, due).is_err() {
                self.refuse(&due, Reason::QueueFull, answer);
            }
        }
    }

    /// Drops a request whose operator has gone; a stop is carried out all the same.
    pub fn drop_abandoned(&mut self, id: RequestId) {
        self.scheduled.retain(|waiting| waiting.id != id);
        let is_abandoned = |heartbeat: &Option<DueRequest>| heartbeat.is_some_and(|heartbeat| heartbeat.id == id);
        self.heartbeats.iter_mut().filter(|heartbeat| is_abandoned(heartbeat)).for_each(|place| *place = None);
    }

    /// The requests that wait, or are under evaluation.
    pub fn waiting(&self) -> impl Iterator<Item = &DueRequest> {
        let waiting = self.stops.iter().chain(self.heartbeats.iter().flatten()).chain(&self.scheduled);
        waiting.chain(&self.under_evaluation)
    }

    /// Refuses the waiting requests that a newer one of the same source overrides.
    fn supersede(&mut self, newer: &Request, answer: &mut impl FnMut(RequestAnswer)) {
        let tick = self.tick;
        let overridden = |older: &Request| older.not_before <= tick && older.is_overridden_by(newer);
        while let Some(at) = self.scheduled.iter().position(|waiting| overridden(&waiting.request)) {
            let older = self.scheduled.remove(at);
            self.refuse(&older, Reason::Superseded, answer);
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
        answer: &mut impl FnMut(RequestAnswer),
    ) -> Option<DueRequest> {
        self.tick = tick;
        if let Some(stop) = self.due_stop(answer) {
            return Some(stop);
        }
        self.refuse_expired(time_ns, answer);
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
    fn refuse_expired(&mut self, time_ns: u64, answer: &mut impl FnMut(RequestAnswer)) {
        let is_expired = |due: &DueRequest| due.request.has_expired(time_ns);
        while self.scheduled.first().is_some_and(|first| first.request.not_before <= self.tick && is_expired(first)) {
            let expired = self.scheduled.remove(0);
            self.refuse(&expired, Reason::Expired, answer);
        }
        for place in 0..self.heartbeats.len() {
            if let Some(expired) = self.heartbeats[place].take_if(|heartbeat| is_expired(heartbeat)) {
                self.refuse(&expired, Reason::Expired, answer);
            }
        }
    }

    /// Takes out a stop that is due, and refuses everything that was to take effect before it.
    fn due_stop(&mut self, answer: &mut impl FnMut(RequestAnswer)) -> Option<DueRequest> {
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
            self.refuse(&waiting, Reason::Superseded, answer);
        }
        Some(stop)
    }

    /// Gives the replies of a tick to `answer`, and remembers what is in force.
    ///
    /// * `submitted` – the request that was submitted before the tick
    pub fn conclude(&mut self, submitted: Option<DueRequest>, tick: &Tick, answer: &mut impl FnMut(RequestAnswer)) {
        self.in_force.half_step = tick.report.half_step.index;
        self.in_force.command = tick.command;
        self.in_force.mode = Some(tick.report.mode);
        self.in_force.latched = tick.latched;
        if let (Some(refusal), Some(superseded)) = (&tick.superseded, self.under_evaluation) {
            self.under_evaluation = None;
            self.decided(&superseded, refusal, answer);
        }
        match (submitted, &tick.reply) {
            (Some(submitted), Some(reply)) => self.decided(&submitted, reply, answer),
            (Some(submitted), None) => self.under_evaluation = Some(submitted),
            (None, Some(reply)) => {
                if let Some(evaluated) = self.under_evaluation.take() {
                    self.decided(&evaluated, reply, answer);
                }
            }
            (None, None) => {}
        }
    }

    fn decided(&mut self, due: &DueRequest, reply: &Reply, answer: &mut impl FnMut(RequestAnswer)) {
        self.in_force.intent = reply.intent;
        if due.id != RequestId::LOOP {
            let reply = Reply { id: due.request.id, ..*reply };
            answer(RequestAnswer { id: due.id, reply, is_heartbeat: due.request.is_empty() });
        }
    }

    /// A refusal of a request with a number of its sender's, which leaves everything in force.
    pub fn refusal(&self, of_sender: u64, reason: Reason) -> Reply {
        let InForce { half_step, command, intent, mode, latched } = self.in_force;
        Reply { id: of_sender, mode, latched, ..Reply::refused(reason, half_step, command, intent) }
    }

    fn refuse(&self, due: &DueRequest, reason: Reason, answer: &mut impl FnMut(RequestAnswer)) {
        let reply = self.refusal(due.request.id, reason);
        answer(RequestAnswer { id: due.id, reply, is_heartbeat: due.request.is_empty() });
    }
}

/// Where the heartbeat of a source is kept.
fn place(source: Source) -> usize {
    Source::OPERATORS.iter().position(|&other| other == source).unwrap_or(0)
}
