//! Runs cyclictest of the rt-tests, the usual measure of wake-up latency, if it is installed.

use std::process::Command;
use std::time::Duration;

use crate::{BenchError, Series};

/// Largest latency in cyclictest's histogram (µs).
const LATEST_US: u64 = 20_000;

/// Whether cyclictest is installed.
pub fn is_installed() -> bool {
    Command::new("cyclictest").arg("--help").output().is_ok()
}

/// Runs cyclictest on a core for so many periods, and adds its times, rounded down to microseconds, to a series.
///
/// # Errors
/// cyclictest failed, or printed no histogram.
pub fn run(core: usize, priority: u8, period: Duration, periods: u64, series: &mut Series) -> Result<(), BenchError> {
    let failed = |cause: String| BenchError::new("cyclictest", cause);
    let numbers = [
        ("-p", u64::from(priority)),
        ("-a", core as u64),
        ("-t", 1),
        ("-i", period.as_micros() as u64),
        ("-l", periods),
        ("-h", LATEST_US),
    ];
    let arguments = numbers.iter().flat_map(|(option, number)| [(*option).to_owned(), number.to_string()]);
    let output = Command::new("cyclictest").args(["-q", "-m"]).args(arguments).output();
    let output = output.map_err(|error| failed(error.to_string()))?;
    let mut counted = 0;
    for (us, count) in histogram(&String::from_utf8_lossy(&output.stdout)) {
        (0..count).for_each(|_| series.add(us as f64 * 1e3));
        counted += count;
    }
    if counted == 0 { Err(failed(String::from_utf8_lossy(&output.stderr).trim().to_owned())) } else { Ok(()) }
}

/// Latencies (µs) with their counts, from cyclictest's output.
fn histogram(output: &str) -> impl Iterator<Item = (u64, u64)> {
    output.lines().filter_map(|line| {
        let mut words = line.split_whitespace();
        let pair = (words.next()?.parse().ok()?, words.next()?.parse().ok()?);
        words.next().is_none().then_some(pair)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn histogram_of_cyclictest_is_parsed() {
        let output = "# Histogram\n000003 000002\n000004 000001\n# Total: 000000003\n# Min Latencies: 00003\n";
        assert_eq!(histogram(output).collect::<Vec<_>>(), [(3, 2), (4, 1)]);
    }
}
