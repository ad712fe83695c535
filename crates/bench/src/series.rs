//! A series: the times of one measured quantity, in rounds.

use hdrhistogram::Histogram;

/// The times of one measured quantity.
#[derive(Clone, Debug)]
pub struct Series {
    /// What was timed.
    pub name: String,
    /// Group of series that are shown in one picture.
    pub group: String,
    over: Reduction,
    /// Times of each round (ps).
    rounds: Vec<Histogram<u64>>,
}

/// How the numbers of the rounds are reduced to one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// The minimum: disturbances only ever lengthen a computation.
    Minimum,
    /// The median: for times that depend on the machine.
    Median,
}

/// Longer times are recorded as this (ps).
const TIME_MAX: u64 = 10_000_000_000_000;
const PER_NS: f64 = 1000.0;
/// Of fewer rounds than this, even the least and the greatest may lie on one side of the median with more than 5 %.
const INTERVAL_ROUNDS_MIN: usize = 6;

impl Series {
    /// A series without any round.
    pub fn new(group: impl Into<String>, name: impl Into<String>, over: Reduction) -> Self {
        Self { name: name.into(), group: group.into(), over, rounds: Vec::new() }
    }

    /// Begins a round.
    pub fn begin_round(&mut self) {
        self.rounds.push(Histogram::new_with_bounds(1, TIME_MAX, 3).expect("three digits of ten seconds"));
    }

    /// Adds a time to the current round (ns). Does not allocate.
    pub fn add(&mut self, ns: f64) {
        if let Some(round) = self.rounds.last_mut() {
            round.saturating_record((ns * PER_NS) as u64);
        }
    }

    /// Number of times in all rounds.
    pub fn count(&self) -> u64 {
        self.rounds.iter().map(Histogram::len).sum()
    }

    /// The time that a share `quantile` of the times does not exceed (ns): the minimum or the median over the rounds.
    /// NaN if nothing was measured.
    pub fn quantile(&self, quantile: f64) -> f64 {
        self.over_rounds(|round| round.value_at_quantile(quantile) as f64 / PER_NS)
    }

    /// The quantile of each round, beginning with the first (ns).
    pub fn quantile_of_rounds(&self, quantile: f64) -> Vec<f64> {
        self.full().map(|round| round.value_at_quantile(quantile) as f64 / PER_NS).collect()
    }

    /// Ratio of this series to another: the median of the rounds' ratios, since a disturbance in a round affects both;
    /// for minima the ratio of the two minima.
    pub fn times(&self, other: &Self, quantile: f64) -> f64 {
        let [ours, theirs] = [self, other].map(|series| series.quantile_of_rounds(quantile));
        if self.over == Reduction::Minimum || ours.len() != theirs.len() {
            return self.quantile(quantile) / other.quantile(quantile);
        }
        median(ours.iter().zip(theirs).map(|(ours, theirs)| ours / theirs).collect())
    }

    /// The 95 % confidence interval (-) of a ratio that is the median of the rounds' ratios, by their ranks alone.
    /// `None` for a ratio of minima, and of fewer than six rounds, which have no such interval.
    pub fn interval(&self, other: &Self, quantile: f64) -> Option<[f64; 2]> {
        let [ours, theirs] = [self, other].map(|series| series.quantile_of_rounds(quantile));
        if self.over == Reduction::Minimum || ours.len() != theirs.len() || ours.len() < INTERVAL_ROUNDS_MIN {
            return None;
        }
        let mut ratios: Vec<f64> = ours.iter().zip(theirs).map(|(ours, theirs)| ours / theirs).collect();
        ratios.sort_by(f64::total_cmp);
        // The number of ratios below the true median is binomial.
        let count = ratios.len() as f64;
        let below = ((count - 1.96 * count.sqrt()) / 2.0).floor().max(0.0) as usize;
        Some([ratios[below], ratios[ratios.len() - 1 - below]])
    }

    /// Whether each round has one time only: it has no quantiles.
    pub fn is_one_per_round(&self) -> bool {
        self.rounds.iter().all(|round| round.len() == 1)
    }

    /// The longest time of all (ns).
    pub fn max(&self) -> f64 {
        self.full().map(|round| round.max() as f64 / PER_NS).fold(f64::NAN, f64::max)
    }

    /// Histogram of the times of all rounds: bins of equal width on a logarithmic scale, each with its upper edge (ns)
    /// and the share of the times in it.
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
            Reduction::Minimum => values.into_iter().fold(f64::NAN, f64::min),
            Reduction::Median => median(values),
        }
    }
}

/// The median; NaN of nothing.
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

    fn series(over: Reduction) -> Series {
        let mut series = Series::new("group", "name", over);
        for of_round in [10.0, 30.0, 20.0, 90.0] {
            series.begin_round();
            (0..1000).for_each(|_| series.add(of_round));
        }
        series
    }

    /// In the second round the machine was busy otherwise.
    #[test]
    fn disturbance_of_a_round_does_not_change_the_ratio_of_two_series() {
        let series = |rounds: [f64; 3]| {
            let mut series = Series::new("group", "name", Reduction::Median);
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
    fn rounds_are_reduced_to_their_minimum_or_median() {
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-3;
        assert!(close(series(Reduction::Minimum).quantile(0.5), 10.0));
        assert!(close(series(Reduction::Median).quantile(0.5), 25.0), "between 20 and 30");
        assert!(close(series(Reduction::Median).max(), 90.0));
        assert_eq!(series(Reduction::Median).count(), 4000);
        assert!(Series::new("", "", Reduction::Median).quantile(0.5).is_nan());
    }

    /// Of twelve rounds, the third and the tenth: 3.9 % of twelve tosses have fewer than three heads or fewer than
    /// three tails.
    #[test]
    fn the_interval_of_a_median_is_that_of_the_binomial_distribution() {
        let series = |rounds: u32, unit: f64| {
            let mut series = Series::new("group", "name", Reduction::Median);
            for round in 1..=rounds {
                series.begin_round();
                series.add(if unit > 1.0 { f64::from(round) * unit } else { 1000.0 });
            }
            series
        };
        let interval = |rounds| series(rounds, 1000.0).interval(&series(rounds, 1.0), 0.5);
        let [low, high] = interval(12).unwrap();
        assert!((low - 3.0).abs() < 0.01 && (high - 10.0).abs() < 0.01, "{low} to {high}");
        let [low, high] = interval(6).unwrap();
        assert!((low - 1.0).abs() < 0.01 && (high - 6.0).abs() < 0.01, "{low} to {high}");
        assert_eq!(interval(5), None);
        assert!(series(12, 1.0).is_one_per_round());
    }

    #[test]
    fn histogram_of_a_series_has_all_times() {
        let spread = series(Reduction::Median).spread(1.0, 50.0, 40);
        assert!((spread.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-12);
        assert_eq!(spread.last().unwrap().1, 0.25, "what is longer is in the last bin");
        assert!((spread.last().unwrap().0 - 50.0).abs() < 1e-9);
    }
}
