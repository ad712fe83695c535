//! When the loops run: the cycles of controller and plant, by either of two clocks.
//!
//! * **realtime**: the first cycle begins with the other side's first message; from then on one begins per period, by
//!   this process's own absolute deadlines, with the newest message there is. Missed periods are skipped as a whole:
//!   the next cycle keeps the phase, covers their time as well, and reports how many they were, so that both sides
//!   agree on the time. The plant's deadlines lie half a period after the controller's ([`Cycles::following`]).
//! * **lockstep**: cycle `k` begins with the other side's message of tick `k`, as soon as that arrives. The plant's
//!   measurement 0 begins; the controller answers measurement `k` with setpoint `k`, the plant answers that with
//!   measurement `k + 1`. So a run depends on nothing but its inputs.

use std::time::Duration;

use interface::Rate;
use runtime::{Period, Wake, now_ns};
use wire::{Latest, LatestReader};

use crate::interrupt::Interrupt;
use crate::phase::PhaseFollower;

/// How long lockstep waits for a message of the other side. Time in which this process is halted does not count.
const SILENCE_MAX: Duration = Duration::from_secs(30);
/// How long a waiting process keeps its core: longer than a cycle of the other side takes. After that it yields the
/// core, and at last it sleeps between two polls: waking up costs more than a whole lockstep cycle.
const SPIN: Duration = Duration::from_micros(50);
const YIELD: Duration = Duration::from_millis(2);
const POLL_INTERVAL: Duration = Duration::from_micros(200);
/// The most that one poll adds to the silence: a process that was away for longer had been halted, and perhaps the
/// other one with it.
const POLL_MAX: Duration = Duration::from_millis(20);
/// Most time that one cycle makes up for: a process that was away for longer had been halted.
const CATCH_UP_MAX: Duration = Duration::from_millis(100);

/// What begins a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// Deadlines of this process.
    Realtime,
    /// Messages of the other process.
    Lockstep,
}

/// The cycles of one process, which receives messages `M` from the other.
pub struct Cycles<M: Latest> {
    timing: CycleTiming,
    reader: LatestReader<M>,
    peer: &'static str,
    ticks: Option<u64>,
    next_tick: u64,
    period: Option<Period>,
    follower: Option<PhaseFollower>,
    /// Time of the message that was there before this process began, if that cannot be meant for it (ns).
    left_over: Option<u64>,
    interrupt: Interrupt,
}

/// When cycles begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CycleTiming {
    /// What begins a cycle.
    pub clock: Clock,
    /// Control periods per second.
    pub rate: Rate,
    /// How long before a deadline the process stops sleeping.
    pub spin: Duration,
}

/// One cycle of a loop.
#[derive(Clone, Copy, Debug)]
pub struct Cycle<M> {
    /// Periods since the first cycle.
    pub tick: u64,
    /// How many periods the cycle covers: 1, or more when some were missed.
    pub periods: u64,
    /// How much time the cycle covers (s).
    pub dt: f64,
    /// How many deadlines passed since the last cycle before the work was done.
    pub missed: u64,
    /// How long after its deadline the cycle began (ns); 0 in lockstep.
    pub late_ns: u64,
    /// The other side's newest message; in lockstep the one of this tick.
    pub message: M,
}

/// In lockstep the other side has stopped sending messages.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no message from the {peer} for {} s (waiting for tick {expected}, {}). In lockstep, start both processes with \
     the same --for",
    SILENCE_MAX.as_secs(),
    last_received.map_or("none received".to_owned(), |tick| format!("last received {tick}"))
)]
pub struct PeerSilent {
    /// The other process: `plant` or `controller`.
    pub peer: &'static str,
    /// The tick whose message did not arrive.
    pub expected: u64,
    /// The tick of the last message that arrived.
    pub last_received: Option<u64>,
}

impl Clock {
    /// The clock's name in summaries and recordings.
    pub const fn text(self) -> &'static str {
        match self {
            Clock::Realtime => "realtime",
            Clock::Lockstep => "lockstep",
        }
    }
}

impl<M: Latest> Cycles<M> {
    /// Cycles that answer the messages of `peer`; at most `ticks` periods, or without end.
    pub fn new(
        timing: CycleTiming,
        reader: LatestReader<M>,
        peer: &'static str,
        ticks: Option<u64>,
        interrupt: Interrupt,
    ) -> Self {
        Self { timing, reader, peer, ticks, next_tick: 0, period: None, follower: None, left_over: None, interrupt }
    }

    /// The same for the side that is answered, with deadlines half a period after the other side's, so that its newest
    /// message is half a period old. A message that is there already answers no message of this process: a killed one
    /// has left it.
    pub fn following(mut self) -> Self {
        let left_over = self.reader.latest().map(|message| message.time_ns());
        Self { follower: Some(PhaseFollower::default()), left_over, ..self }
    }

    /// Whether the process was asked to end.
    pub fn is_interrupted(&self) -> bool {
        self.interrupt.is_raised()
    }

    /// Control periods per second.
    pub fn rate(&self) -> Rate {
        self.timing.rate
    }

    /// Waits for the next cycle; `None` at the end, or when the process was asked to end. While it waits for a message,
    /// `idle` is called now and then.
    ///
    /// # Errors
    /// In lockstep no message has arrived for too long.
    pub fn wait(&mut self, idle: impl FnMut()) -> Result<Option<Cycle<M>>, PeerSilent> {
        if self.is_over() {
            return Ok(None);
        }
        match (self.timing.clock, &mut self.period) {
            (Clock::Lockstep, _) => self.wait_for_message(idle),
            (Clock::Realtime, None) => {
                let first = self.wait_for_message(idle);
                let CycleTiming { rate, spin, .. } = self.timing;
                let period = match (&first, &self.follower) {
                    (Ok(Some(cycle)), Some(_)) => PhaseFollower::first(rate.period(), cycle.message.time_ns()),
                    _ => Period::starting_now(rate.period()),
                };
                self.period = Some(period.with_spin(spin));
                first
            }
            (Clock::Realtime, Some(period)) => {
                let Wake { skipped, missed, late_ns } = period.wait();
                let periods = 1 + skipped.min(catch_up_max(self.timing.rate));
                let message = self.reader.latest();
                if let (Some(follower), Some(message)) = (&mut self.follower, &message) {
                    follower.follow(message.time_ns(), period);
                }
                self.next_tick += periods;
                let tick = self.next_tick - 1;
                let message = message.filter(|_| !self.is_over_at(tick));
                Ok(message.map(|message| Cycle { missed, late_ns, ..self.cycle(tick, periods, message) }))
            }
        }
    }

    fn cycle(&self, tick: u64, periods: u64, message: M) -> Cycle<M> {
        let dt = periods as f64 * self.timing.rate.period_s();
        Cycle { tick, periods, dt, missed: 0, late_ns: 0, message }
    }

    fn is_over(&self) -> bool {
        self.is_over_at(self.next_tick)
    }

    fn is_over_at(&self, tick: u64) -> bool {
        self.ticks.is_some_and(|ticks| tick >= ticks) || self.interrupt.is_raised()
    }

    /// Waits for the message of the next tick; in real time for any message.
    fn wait_for_message(&mut self, mut idle: impl FnMut()) -> Result<Option<Cycle<M>>, PeerSilent> {
        let began = now_ns();
        let (mut polled_at, mut silence) = (began, Duration::ZERO);
        let expected = self.next_tick;
        let is_realtime = self.timing.clock == Clock::Realtime;
        loop {
            let newest = self.reader.latest();
            let newest = newest.filter(|message| self.left_over != Some(message.time_ns()));
            if let Some(message) = newest.filter(|message| is_realtime || message.tick() == expected) {
                self.next_tick += 1;
                return Ok(Some(self.cycle(expected, 1, message)));
            }
            if self.interrupt.is_raised() {
                return Ok(None);
            }
            let now = now_ns();
            let waited = Duration::from_nanos(now - began);
            silence += Duration::from_nanos(now - std::mem::replace(&mut polled_at, now)).min(POLL_MAX);
            if waited < SPIN {
                std::hint::spin_loop();
                continue;
            }
            if waited < YIELD {
                std::thread::yield_now();
                continue;
            }
            idle();
            if self.timing.clock == Clock::Lockstep && silence > SILENCE_MAX {
                let last_received = newest.map(|message| message.tick());
                return Err(PeerSilent { peer: self.peer, expected, last_received });
            }
            std::thread::sleep(POLL_INTERVAL);
        }
    }
}

/// Most missed periods that one cycle makes up for.
fn catch_up_max(rate: Rate) -> u64 {
    rate.ticks(CATCH_UP_MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_cycle_makes_up_for_a_tenth_of_a_second_at_any_rate() {
        let at = |hz| catch_up_max(Rate::new(hz).expect("a rate that loops can keep"));
        assert_eq!([250, 1000, 4000].map(at), [25, 100, 400]);
    }
}
