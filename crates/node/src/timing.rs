//! How well a loop kept time: how late its periods began, and how long they took.

use std::fmt;

use hdrhistogram::Histogram;
use serde::{Deserialize, Serialize};

/// Times of all periods of a loop. Adding one neither allocates nor fails.
#[derive(Clone, Debug)]
pub struct TimingHistogram {
    late_ns: Histogram<u64>,
    took_ns: Histogram<u64>,
}

/// How well a loop kept time over a whole run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TimingStats {
    /// From the deadline to the begin of the period.
    pub late: Quantiles,
    /// From the begin of the period to writing the setpoint.
    pub took: Quantiles,
}

/// Quantiles of a set of times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Quantiles {
    /// The median (µs).
    pub p50_us: f64,
    /// The time that one in a hundred exceeds (µs).
    pub p99_us: f64,
    /// The longest time (µs).
    pub max_us: f64,
}

/// Longer times are recorded as this (ns).
const TIME_MAX: u64 = 10_000_000_000;

impl TimingHistogram {
    /// A histogram without any period.
    pub fn new() -> Self {
        let empty = Histogram::new_with_bounds(1, TIME_MAX, 2).expect("two digits of ten seconds");
        Self { late_ns: empty.clone(), took_ns: empty }
    }

    /// Adds a period that began `late_ns` after its deadline and took `took_ns`.
    pub fn add(&mut self, late_ns: u64, took_ns: u64) {
        self.late_ns.saturating_record(late_ns);
        self.took_ns.saturating_record(took_ns);
    }

    /// Quantiles of the periods so far.
    pub fn stats(&self) -> TimingStats {
        let quantiles = |times: &Histogram<u64>| {
            let us = |ns: u64| ns as f64 / 1e3;
            let quantile = |quantile| us(times.value_at_quantile(quantile));
            Quantiles { p50_us: quantile(0.5), p99_us: quantile(0.99), max_us: us(times.max()) }
        };
        TimingStats { late: quantiles(&self.late_ns), took: quantiles(&self.took_ns) }
    }
}

impl Default for TimingHistogram {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Display for TimingStats {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "periods began {} late and took {}", self.late, self.took)
    }
}

impl fmt::Display for Quantiles {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{:.1} µs (99 %: {:.0} µs, most: {:.0} µs)", self.p50_us, self.p99_us, self.max_us)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn p99_of_a_loop_is_the_time_that_one_period_in_a_hundred_exceeds() {
        let mut times = TimingHistogram::new();
        for period in 0..1000 {
            times.add(period, if period < 985 { 5_000 } else { 80_000 });
        }
        times.add(u64::MAX, 0);
        let TimingStats { late, took } = times.stats();
        assert!((took.p50_us - 5.0).abs() < 0.1 && (took.p99_us - 80.0).abs() < 1.0, "{took:?}");
        assert!((late.p50_us - 0.5).abs() < 0.01 && late.max_us > 9e6, "{late:?}");
    }
}
