//! Periods with absolute deadlines: the n-th begins at `start + n · period`, however long the work took.
//!
//! * **deadline**: an absolute time on `CLOCK_MONOTONIC`, which is never set and shared by all processes of the
//!   machine.
//! * **skipped**: a whole period in which the loop did not wake up. After a delay of 2.3 periods two are skipped; the
//!   third begins at once, 0.3 periods late, and the next one on time: the phase is kept, and nothing is caught up.
//! * **missed**: a deadline that passed before the work was done. After a delay of 2.3 periods three were missed, after
//!   one of 0.3 periods one.
//! * **spin**: the time before the deadline that is spent busy-waiting instead of sleeping, since no system wakes a
//!   thread up to the microsecond.

use std::time::Duration;

use rustix::io::Errno;
use rustix::thread::{ClockId, clock_nanosleep_absolute};
use rustix::time::{Timespec, clock_gettime};

/// A grid of deadlines, and the next one on it.
#[derive(Clone, Copy, Debug)]
pub struct Period {
    /// Length of a period (ns).
    length_ns: u64,
    /// The next deadline on `CLOCK_MONOTONIC` (ns).
    deadline_ns: u64,
    /// Busy-waiting time before each deadline (ns).
    spin_ns: u64,
}

/// The beginning of a period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wake {
    /// Number of whole periods that were skipped.
    pub skipped: u64,
    /// Number of deadlines that passed before the work was done: 0 as long as it fits into the period.
    pub missed: u64,
    /// Lateness after the deadline (ns).
    pub late_ns: u64,
}

impl Period {
    /// Periods of `length` from now on; the first deadline is one `length` away. Shorter lengths than 1 ns count as 1
    /// ns.
    pub fn starting_now(length: Duration) -> Self {
        let length_ns = u64::try_from(length.as_nanos()).unwrap_or(u64::MAX / 2).max(1);
        Self { length_ns, deadline_ns: now_ns().saturating_add(length_ns), spin_ns: 0 }
    }

    /// Periods of `length` whose deadlines are a whole number of periods from `origin_ns` on `CLOCK_MONOTONIC`: the
    /// first one at least `after` from now.
    pub fn on_grid(length: Duration, origin_ns: u64, after: Duration) -> Self {
        let mut period = Self::starting_now(length);
        let earliest = now_ns().saturating_add(u64::try_from(after.as_nanos()).unwrap_or(u64::MAX / 2));
        period.deadline_ns = first_on_grid(period.length_ns, origin_ns, earliest);
        period
    }

    /// Moves the next deadline, and with it all later ones.
    pub fn shift(&mut self, by_ns: i64) {
        self.deadline_ns = self.deadline_ns.saturating_add_signed(by_ns);
    }

    /// Length of a period (ns).
    pub fn length_ns(&self) -> u64 {
        self.length_ns
    }

    /// The same periods, with busy-waiting for the last `spin` before each deadline. At most half a period: a thread
    /// that never sleeps blocks others.
    pub fn with_spin(self, spin: Duration) -> Self {
        let spin_ns = u64::try_from(spin.as_nanos()).unwrap_or(u64::MAX).min(self.length_ns / 2);
        Self { spin_ns, ..self }
    }

    /// Waits until the deadline, unless it has passed, and moves it on by one period. Neither allocates nor fails; the
    /// only system call is the sleep.
    pub fn wait(&mut self) -> Wake {
        let now = now_ns();
        let is_late = now > self.deadline_ns;
        let skipped = self.skip_missed(now);
        let deadline_ns = self.deadline_ns;
        sleep_until(deadline_ns - self.spin_ns);
        let mut woke_ns = now_ns();
        while woke_ns < deadline_ns {
            std::hint::spin_loop();
            woke_ns = now_ns();
        }
        self.deadline_ns = deadline_ns.saturating_add(self.length_ns);
        Wake { skipped, missed: skipped + u64::from(is_late), late_ns: woke_ns - deadline_ns }
    }

    /// The next deadline on `CLOCK_MONOTONIC` (ns).
    pub fn deadline_ns(&self) -> u64 {
        self.deadline_ns
    }

    /// Moves the deadline over the whole periods that have passed since, and returns their number.
    fn skip_missed(&mut self, now_ns: u64) -> u64 {
        let missed = now_ns.saturating_sub(self.deadline_ns) / self.length_ns;
        self.deadline_ns += missed * self.length_ns;
        missed
    }
}

/// The first deadline on a grid that is not before `earliest`.
fn first_on_grid(length_ns: u64, origin_ns: u64, earliest: u64) -> u64 {
    let phase = origin_ns % length_ns;
    let before = earliest.saturating_sub(phase).div_ceil(length_ns);
    before.saturating_mul(length_ns).saturating_add(phase)
}

/// The time on `CLOCK_MONOTONIC` (ns), the same in all processes of the machine.
pub fn now_ns() -> u64 {
    let now = clock_gettime(ClockId::Monotonic);
    // Neither part of a monotonic clock is ever negative.
    now.tv_sec as u64 * NS_PER_S + now.tv_nsec as u64
}

const NS_PER_S: u64 = 1_000_000_000;

fn sleep_until(deadline_ns: u64) {
    let deadline = Timespec { tv_sec: (deadline_ns / NS_PER_S) as i64, tv_nsec: (deadline_ns % NS_PER_S) as i64 };
    // A signal may wake the thread early; since the deadline is absolute, sleeping again loses nothing.
    while clock_nanosleep_absolute(ClockId::Monotonic, &deadline) == Err(Errno::INTR) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_period_sleeps_until_its_deadline_however_long_the_work_takes() {
        let length = Duration::from_millis(5);
        let mut period = Period::starting_now(length);
        let first = period.deadline_ns();
        let mut deadlines = 0;
        for _ in 0..10 {
            deadlines += period.wait().skipped + 1;
            assert!(now_ns() >= period.deadline_ns() - length.as_nanos() as u64, "woke up before the deadline");
            // Some work, which must not add to the period.
            std::thread::sleep(Duration::from_millis(2));
        }
        assert_eq!(period.deadline_ns(), first + deadlines * 5_000_000, "the deadlines stay on their grid");
    }

    #[test]
    fn spinning_does_not_begin_a_period_early_or_lose_one() {
        let mut period = Period::starting_now(Duration::from_millis(2)).with_spin(Duration::from_millis(1));
        for _ in 0..10 {
            let deadline = period.deadline_ns();
            let wake = period.wait();
            assert!(now_ns() >= deadline + wake.skipped * 2_000_000 + wake.late_ns);
            assert_eq!(period.deadline_ns(), deadline + (1 + wake.skipped) * 2_000_000);
        }
        assert_eq!(period.with_spin(Duration::MAX).spin_ns, 1_000_000, "half of the period is slept");
    }

    #[test]
    fn a_late_loop_counts_its_missed_periods_and_keeps_its_phase() {
        let mut period = Period { length_ns: 100, deadline_ns: 1000, spin_ns: 0 };
        assert_eq!((period.skip_missed(700), period.deadline_ns), (0, 1000));
        assert_eq!((period.skip_missed(1000), period.deadline_ns), (0, 1000), "just in time");
        assert_eq!((period.skip_missed(1099), period.deadline_ns), (0, 1000), "late, but within the period");
        assert_eq!((period.skip_missed(1230), period.deadline_ns), (2, 1200), "2.3 periods late");
    }

    #[test]
    fn periods_missed_by_a_stall_are_counted() {
        let mut period = Period::starting_now(Duration::from_millis(1));
        period.wait();
        std::thread::sleep(Duration::from_millis(20));
        let wake = period.wait();
        assert!(wake.skipped >= 18);
        assert_eq!(wake.missed, wake.skipped + 1);
    }

    #[test]
    fn work_that_is_a_little_too_long_misses_its_deadline_without_a_skipped_period() {
        let mut period = Period::starting_now(Duration::from_secs(1));
        period.deadline_ns = now_ns() - 1;
        let wake = period.wait();
        assert_eq!((wake.skipped, wake.missed), (0, 1));
    }

    #[test]
    fn deadlines_lie_on_the_grid_of_another_process() {
        for (origin, earliest, deadline) in
            [(1030, 1030, 1030), (1030, 1031, 1130), (1030, 2999, 3030), (1030, 430, 430), (30, 0, 30), (30, 31, 130)]
        {
            assert_eq!(first_on_grid(100, origin, earliest), deadline, "{origin} {earliest}");
        }
        let mut period = Period { length_ns: 100, deadline_ns: 1000, spin_ns: 0 };
        period.shift(-30);
        assert_eq!(period.deadline_ns, 970);
        period.shift(50);
        assert_eq!(period.deadline_ns, 1020);
    }

    #[test]
    fn periods_of_extreme_length_do_not_overflow() {
        assert_eq!(Period::starting_now(Duration::ZERO).length_ns, 1);
        let mut period = Period::starting_now(Duration::MAX);
        assert_eq!(period.skip_missed(now_ns()), 0);
    }
}
