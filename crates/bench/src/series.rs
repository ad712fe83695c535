//! A series: the times of one thing, in rounds.

use hdrhistogram::Histogram;

/// Times of one thing.
#[derive(Clone, Debug)]
pub struct Series {
    /// What was timed.
    pub name: String,
    /// In which picture it is shown, beside others.
    pub group: String,
    over: Over,
    /// [ps]
    rounds: Vec<Histogram<u64>>,
}

/// How a number comes from the rounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// The least: the machine only ever adds to what is computed.
    Minimum,
    /// The middle one: of what depends on the machine.
    Median,
}

/// Nothing that is timed here takes longer [ps].
const LONGEST: u64 = 10_000_000_000_000;
const PER_NS: f64 = 1000.0;

impl Series {
    /// Empty.
    pub fn new(group: impl Into<String>, name: impl Into<String>, over: Over) -> Self {
        Self { name: name.into(), group: group.into(), over, rounds: Vec::new() }
    }

    /// Begins a round.
    pub fn begin_round(&mut self) {
        self.rounds.push(Histogram::new_with_bounds(1, LONGEST, 3).expect("three digits of ten seconds"));
    }

    /// Adds a time to the round [ns]. Does not allocate.
    pub fn add(&mut self, ns: f64) {
        if let Some(round) = self.rounds.last_mut() {
            round.saturating_record((ns * PER_NS) as u64);
        }
    }

    /// How many times there are in all rounds.
    pub fn count(&self) -> u64 {
        self.rounds.iter().map(Histogram::len).sum()
    }

    /// The time that a share `quantile` of the times does not exceed [ns]: the minimum or the median over the rounds. NaN
    /// when nothing was timed.
    pub fn quantile(&self, quantile: f64) -> f64 {
        self.over_rounds(|round| round.value_at_quantile(quantile) as f64 / PER_NS)
    }

    /// Of each round, beginning with the first [ns].
    pub fn quantile_of_rounds(&self, quantile: f64) -> Vec<f64> {
        self.full().map(|round| round.value_at_quantile(quantile) as f64 / PER_NS).collect()
    }

    /// How many times as long as another this is: round by round where both took turns, since what disturbs the one disturbs
    /// the other, and the median of that; the ratio of what counts where that is the least of all.
    pub fn times(&self, other: &Self, quantile: f64) -> f64 {
        let [ours, theirs] = [self, other].map(|series| series.quantile_of_rounds(quantile));
        if self.over == Over::Minimum || ours.len() != theirs.len() {
            return self.quantile(quantile) / other.quantile(quantile);
        }
        median(ours.iter().zip(theirs).map(|(ours, theirs)| ours / theirs).collect())
    }

    /// The longest time of all [ns].
    pub fn max(&self) -> f64 {
        self.full().map(|round| round.max() as f64 / PER_NS).fold(f64::NAN, f64::max)
    }

    /// How the times of all rounds are spread: so many bins whose widths are equal on a logarithmic scale, each with its
    /// upper edge [ns] and the share of the times in it.
    pub fn spread(&self, least_ns: f64, greatest_ns: f64, bins: usize) -> Vec<(f64, f64)> {
        let mut shares = vec![0.0; bins];
        let (from, to) = (least_ns.ln(), greatest_ns.ln());
        for round in self.full() {
            for value in round.iter_recorded() {
                let ns = value.value_iterated_to() as f64 / PER_NS;
                let place = (ns.max(least_ns).ln() - from) / (to - from) * bins as f64;
                shares[(place as usize).min(bins - 1)] += value.count_since_last_iteration() as f64;
            }
        }
        let count = (self.count() as f64).max(1.0);
        let edge = |bin: usize| (from + (to - from) * (bin + 1) as f64 / bins as f64).exp();
        shares.iter().enumerate().map(|(bin, share)| (edge(bin), share / count)).collect()
    }

    fn full(&self) -> impl Iterator<Item = &Histogram<u64>> {
        self.rounds.iter().filter(|round| !round.is_empty())
    }

    fn over_rounds(&self, of: impl Fn(&Histogram<u64>) -> f64) -> f64 {
        let values: Vec<f64> = self.full().map(of).collect();
        match self.over {
            Over::Minimum => values.into_iter().fold(f64::NAN, f64::min),
            Over::Median => median(values),
        }
    }
}

/// The middle one, or between the two in the middle; NaN of nothing.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        count => (values[(count - 1) / 2] + values[count / 2]) / 2.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(over: Over) -> Series {
        let mut series = Series::new("group", "name", over);
        for of_round in [10.0, 30.0, 20.0, 90.0] {
            series.begin_round();
            (0..1000).for_each(|_| series.add(of_round));
        }
        series
    }

    /// In the second round the machine was busy with something else.
    #[test]
    fn what_disturbs_both_disturbs_no_ratio() {
        let series = |rounds: [f64; 3]| {
            let mut series = Series::new("group", "name", Over::Median);
            for ns in rounds {
                series.begin_round();
                series.add(ns);
            }
            series
        };
        let ratio = series([10.0, 40.0, 44.0]).times(&series([10.0, 40.0, 11.0]), 0.5);
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    }

    #[test]
    fn the_rounds_are_told_by_their_least_or_their_middle() {
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-3;
        assert!(close(series(Over::Minimum).quantile(0.5), 10.0));
        assert!(close(series(Over::Median).quantile(0.5), 25.0), "between 20 and 30");
        assert!(close(series(Over::Median).max(), 90.0));
        assert_eq!(series(Over::Median).count(), 4000);
        assert!(Series::new("", "", Over::Median).quantile(0.5).is_nan());
    }

    #[test]
    fn the_spread_is_all_there_is() {
        let spread = series(Over::Median).spread(1.0, 50.0, 40);
        assert!((spread.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-12);
        assert_eq!(spread.last().unwrap().1, 0.25, "what is longer is in the last bin");
        assert!((spread.last().unwrap().0 - 50.0).abs() < 1e-9);
    }
}
