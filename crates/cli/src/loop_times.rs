//! How a loop kept time: how late its periods began, and what they took.

use std::fmt;

use hdrhistogram::Histogram;
use serde::{Deserialize, Serialize};

/// The times of a loop's periods. To add one neither allocates nor fails.
#[derive(Clone, Debug)]
pub struct LoopTimes {
    late_ns: Histogram<u64>,
    took_ns: Histogram<u64>,
}

/// What there is to say of them at the end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KeptTime {
    /// From a deadline to the begin of its period.
    pub late: Spread,
    /// From the begin of a period to the setpoint's departure.
    pub took: Spread,
}

/// How times are spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Half of them are shorter [µs].
    pub p50_us: f64,
    /// One in a hundred is longer [µs].
    pub p99_us: f64,
    /// The longest [µs].
    pub max_us: f64,
}

/// What is longer counts as this long [ns].
const LONGEST: u64 = 10_000_000_000;

impl LoopTimes {
    /// None yet.
    pub fn new() -> Self {
        let empty = Histogram::new_with_bounds(1, LONGEST, 2).expect("two digits of ten seconds");
        Self { late_ns: empty.clone(), took_ns: empty }
    }

    /// Adds a period.
    pub fn add(&mut self, late_ns: u64, took_ns: u64) {
        self.late_ns.saturating_record(late_ns);
        self.took_ns.saturating_record(took_ns);
    }

    /// What there is to say.
    pub fn kept(&self) -> KeptTime {
        let spread = |times: &Histogram<u64>| {
            let us = |ns: u64| ns as f64 / 1e3;
            let quantile = |quantile| us(times.value_at_quantile(quantile));
            Spread { p50_us: quantile(0.5), p99_us: quantile(0.99), max_us: us(times.max()) }
        };
        KeptTime { late: spread(&self.late_ns), took: spread(&self.took_ns) }
    }
}

impl Default for LoopTimes {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Display for KeptTime {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "periods began {} late and took {}", self.late, self.took)
    }
}

impl fmt::Display for Spread {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{:.1} µs (99 %: {:.0} µs, most: {:.0} µs)", self.p50_us, self.p99_us, self.max_us)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_in_a_hundred_is_longer() {
        let mut times = LoopTimes::new();
        for period in 0..1000 {
            times.add(period, if period < 985 { 5_000 } else { 80_000 });
        }
        times.add(u64::MAX, 0);
        let KeptTime { late, took } = times.kept();
        assert!((took.p50_us - 5.0).abs() < 0.1 && (took.p99_us - 80.0).abs() < 1.0, "{took:?}");
        assert!((late.p50_us - 0.5).abs() < 0.01 && late.max_us > 9e6, "{late:?}");
    }
}
