//! Rate: how many control periods there are in a second.

use std::fmt;
use std::time::Duration;

/// A rate that a loop can keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    hz: u32,
}

impl Rate {
    /// Slower, and the ankles answer too late [Hz].
    pub const HZ_MIN: u32 = 250;
    /// Faster, and waking up takes the larger part of a period [Hz].
    pub const HZ_MAX: u32 = 4000;

    /// So many periods a second; `None` if that is out of [`HZ_MIN`](Self::HZ_MIN) to [`HZ_MAX`](Self::HZ_MAX).
    pub fn new(hz: u32) -> Option<Self> {
        (Self::HZ_MIN..=Self::HZ_MAX).contains(&hz).then_some(Self { hz })
    }

    /// Periods in a second [Hz].
    pub fn hz(self) -> u32 {
        self.hz
    }

    /// Length of a period.
    pub fn period(self) -> Duration {
        Duration::from_secs(1) / self.hz
    }

    /// Length of a period [s].
    pub fn period_s(self) -> f64 {
        1.0 / f64::from(self.hz)
    }

    /// The tick that is nearest to a time since the start.
    pub fn ticks(self, time: Duration) -> u64 {
        (time.as_secs_f64() / self.period_s()).round() as u64
    }

    /// The time of a tick since the start [s].
    pub fn time(self, ticks: u64) -> f64 {
        ticks as f64 * self.period_s()
    }
}

/// A thousand periods a second.
impl Default for Rate {
    fn default() -> Self {
        Self { hz: 1000 }
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
    fn times_and_ticks_are_the_same_thing() {
        let rate = Rate::new(250).unwrap();
        assert_eq!((rate.period(), rate.period_s()), (Duration::from_millis(4), 0.004));
        assert_eq!(rate.ticks(Duration::from_millis(41)), 10);
        assert_eq!(rate.time(10), 0.04);
        assert_eq!(Rate::default().time(7), 7.0 * 1e-3);
    }

    #[test]
    fn what_no_loop_keeps_is_refused() {
        assert_eq!(Rate::new(249), None);
        assert_eq!(Rate::new(4001), None);
        assert_eq!(Rate::new(4000).map(Rate::hz), Some(4000));
    }
}
