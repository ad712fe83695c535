//! The control rate: periods per second.

use std::fmt;
use std::time::Duration;

/// A control rate that a loop can keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    hz: u32,
}

impl Rate {
    /// Lowest rate (Hz): below it the ankle feedback responds too late.
    pub const HZ_MIN: u32 = 250;
    /// Highest rate (Hz): above it waking up takes the larger part of a period.
    pub const HZ_MAX: u32 = 4000;

    /// A rate of `hz` periods per second; `None` outside of [`HZ_MIN`](Self::HZ_MIN) to [`HZ_MAX`](Self::HZ_MAX).
    pub fn new(hz: u32) -> Option<Self> {
        (Self::HZ_MIN..=Self::HZ_MAX).contains(&hz).then_some(Self { hz })
    }

    /// A rate of `hz` periods per second, or the nearest one that a loop can keep.
    pub fn clamped(hz: u32) -> Self {
        Self { hz: hz.clamp(Self::HZ_MIN, Self::HZ_MAX) }
    }

    /// Periods per second (Hz).
    pub fn hz(self) -> u32 {
        self.hz
    }

    /// Length of a period.
    pub fn period(self) -> Duration {
        Duration::from_secs(1) / self.hz
    }

    /// Length of a period (s).
    pub fn period_s(self) -> f64 {
        1.0 / f64::from(self.hz)
    }

    /// The tick that is nearest to a time since the start.
    pub fn ticks(self, time: Duration) -> u64 {
        (time.as_secs_f64() / self.period_s()).round() as u64
    }

    /// The time of a tick since the start (s).
    pub fn time(self, ticks: u64) -> f64 {
        ticks as f64 * self.period_s()
    }
}

impl fmt::Display for Rate {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{} Hz", self.hz)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_ticks_convert_into_each_other() {
        let rate = Rate::new(250).unwrap();
        assert_eq!((rate.period(), rate.period_s()), (Duration::from_millis(4), 0.004));
        assert_eq!(rate.ticks(Duration::from_millis(41)), 10);
        assert_eq!(rate.time(10), 0.04);
        assert_eq!(Rate::clamped(1000).time(7), 7.0 * 1e-3);
    }

    #[test]
    fn rates_that_no_loop_can_keep_are_refused_or_clamped() {
        assert_eq!(Rate::new(249), None);
        assert_eq!(Rate::new(4001), None);
        assert_eq!(Rate::new(4000).map(Rate::hz), Some(4000));
        assert_eq!((Rate::clamped(0).hz(), Rate::clamped(5000).hz()), (250, 4000));
    }
}
