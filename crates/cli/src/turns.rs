//! Whose turn it is: when the controller ticks and the plant steps, by either of the two clocks.
//!
//! * **realtime**: the first turn comes with the other side's first message, from then on one per period by this
//!   process's own absolute deadlines; whatever message is newest counts. Whole periods that were missed are skipped: the
//!   next turn keeps the phase, is for their time, too, and says how many they were, so that both sides keep to the same
//!   time.
//! * **lockstep**: turn `k` comes with the other side's message of tick `k`, as soon as that is there. The plant's
//!   measurement 0 begins; the controller answers measurement `k` with setpoint `k`, the plant answers that with
//!   measurement `k + 1`. So a run depends on nothing but its inputs.

use std::time::Duration;

use runtime::{Period, Rate, Wake, now_ns};
use wire::{Newest, NewestReader};

use crate::interrupt::Interrupt;

/// Longest silence of the other side that lockstep bears.
const SILENCE_MAX: Duration = Duration::from_secs(30);
/// How long a waiting process keeps its core, longer than a turn of the other side takes; then it lets others have it, and
/// at last it sleeps between two looks: waking up costs more than a whole lockstep turn.
const SPIN: Duration = Duration::from_micros(50);
const YIELD: Duration = Duration::from_millis(2);
const NAP: Duration = Duration::from_micros(200);
/// Most periods that one turn makes up for: whoever was away for longer has been halted, and nothing was to be done then.
const MADE_UP_MAX: u64 = 100;

/// By what a process goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// Its own deadlines.
    Realtime,
    /// The other side's messages.
    Lockstep,
}

/// The turns of one side, which hears messages `M` from the other.
pub struct Turns<M: Newest> {
    pace: Pace,
    reader: NewestReader<M>,
    peer: &'static str,
    ticks: Option<u64>,
    next_tick: u64,
    period: Option<Period>,
    missed_in_a_row: u64,
    interrupt: Interrupt,
}

/// How a process goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    /// By what.
    pub clock: Clock,
    /// How many periods there are in a second.
    pub rate: Rate,
    /// How long before a deadline sleeping ends.
    pub spin: Duration,
}

/// One turn.
#[derive(Clone, Copy, Debug)]
pub struct Turn<M> {
    /// Periods since the first turn.
    pub tick: u64,
    /// How many periods this turn is for: 1, or more when some were missed.
    pub periods: u64,
    /// How long it is for [s].
    pub dt: f64,
    /// How many deadlines were missed since the last turn.
    pub missed: u64,
    /// How long after its deadline it began [ns]; 0 in lockstep.
    pub late_ns: u64,
    /// How many were missed since the last turn that came in time.
    pub missed_in_a_row: u64,
    /// The other side's newest message; in lockstep the one of this tick.
    pub message: M,
}

/// Lockstep ends when the other side says nothing any more.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the {peer} has been silent for {} s: its tick {wanted} did not come, {}. In lockstep both sides start together and \
     run for the same time (--for)",
    SILENCE_MAX.as_secs(),
    heard.map_or("nothing was ever heard from it".to_owned(), |tick| format!("the last was {tick}"))
)]
pub struct PeerSilent {
    /// `plant` or `controller`.
    pub peer: &'static str,
    /// The tick that was waited for.
    pub wanted: u64,
    /// The tick of its last message.
    pub heard: Option<u64>,
}

impl Clock {
    /// In a word.
    pub const fn text(self) -> &'static str {
        match self {
            Clock::Realtime => "realtime",
            Clock::Lockstep => "lockstep",
        }
    }
}

impl<M: Newest> Turns<M> {
    /// Turns that come from the `peer`'s messages; at most `ticks` periods, or without end.
    pub fn new(
        pace: Pace,
        reader: NewestReader<M>,
        peer: &'static str,
        ticks: Option<u64>,
        interrupt: Interrupt,
    ) -> Self {
        Self { pace, reader, peer, ticks, next_tick: 0, period: None, missed_in_a_row: 0, interrupt }
    }

    /// Waits for the next turn; `None` at the end, or when the process was asked to end. While there is nothing to do but
    /// wait, `idle` is called now and then.
    ///
    /// # Errors
    /// In lockstep the other side has been silent for too long.
    pub fn wait(&mut self, idle: impl FnMut()) -> Result<Option<Turn<M>>, PeerSilent> {
        if self.is_over() {
            return Ok(None);
        }
        match (self.pace.clock, &mut self.period) {
            (Clock::Lockstep, _) => self.wait_for_message(idle),
            (Clock::Realtime, None) => {
                let first = self.wait_for_message(idle);
                let Pace { rate, spin, .. } = self.pace;
                self.period = Some(Period::starting_now(rate.period()).with_spin(spin));
                first
            }
            (Clock::Realtime, Some(period)) => {
                let Wake { missed, late_ns } = period.wait();
                self.missed_in_a_row = if missed > 0 { self.missed_in_a_row + missed } else { 0 };
                let periods = 1 + missed.min(MADE_UP_MAX);
                self.next_tick += periods;
                let tick = self.next_tick - 1;
                let message = self.reader.newest().filter(|_| !self.is_over_at(tick));
                Ok(message.map(|message| Turn { missed, late_ns, ..self.turn(tick, periods, message) }))
            }
        }
    }

    fn turn(&self, tick: u64, periods: u64, message: M) -> Turn<M> {
        let dt = periods as f64 * self.pace.rate.period_s();
        Turn { tick, periods, dt, missed: 0, late_ns: 0, missed_in_a_row: self.missed_in_a_row, message }
    }

    fn is_over(&self) -> bool {
        self.is_over_at(self.next_tick)
    }

    fn is_over_at(&self, tick: u64) -> bool {
        self.ticks.is_some_and(|ticks| tick >= ticks) || self.interrupt.is_raised()
    }

    /// Waits for the message of the next tick; in real time for any.
    fn wait_for_message(&mut self, mut idle: impl FnMut()) -> Result<Option<Turn<M>>, PeerSilent> {
        let began = now_ns();
        let wanted = self.next_tick;
        loop {
            let heard = self.reader.newest();
            if let Some(message) = heard.filter(|heard| self.pace.clock == Clock::Realtime || heard.tick() == wanted) {
                self.next_tick += 1;
                return Ok(Some(self.turn(wanted, 1, message)));
            }
            if self.interrupt.is_raised() {
                return Ok(None);
            }
            let waited = Duration::from_nanos(now_ns() - began);
            if waited < SPIN {
                std::hint::spin_loop();
                continue;
            }
            if waited < YIELD {
                std::thread::yield_now();
                continue;
            }
            idle();
            if self.pace.clock == Clock::Lockstep && waited > SILENCE_MAX {
                return Err(PeerSilent { peer: self.peer, wanted, heard: heard.map(|message| message.tick()) });
            }
            std::thread::sleep(NAP);
        }
    }
}
