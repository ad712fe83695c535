//! How well the paths of a candidate agree with the stated verdicts.

use std::cmp::Ordering;

use model::Sole;
use nalgebra::Vector2;

use crate::{PaperVerdict, Scenario, ZmpExtents};

/// What a verdict should have to spare (m): a body on the very threshold shows nothing.
pub(super) const SPARE: f64 = 2e-4;

/// How the stated verdicts turn out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Verdicts {
    /// For each scenario, how far the least margin is on the side of the threshold that the paper states (m): negative
    /// where the verdict does not hold.
    pub slack: Vec<f64>,
    /// For each scenario, whether the paper's verdict holds.
    pub holds: Vec<bool>,
}

impl Verdicts {
    /// Judges the ZMP path of each scenario, of which the paper states a verdict, over a sole.
    pub(super) fn of_paths(scenarios: &[Scenario], paths: &[Vec<Vector2<f64>>], sole: &Sole) -> Self {
        let margins = paths.iter().map(|path| ZmpExtents::of_path(path.iter().copied(), sole).margin);
        let judged = scenarios.iter().zip(margins).map(|(scenario, margin)| {
            let slack = if scenario.paper_verdict == PaperVerdict::Out { -margin } else { margin };
            (slack, scenario.paper_verdict.agrees(margin > 0.0) == Some(true))
        });
        let (slack, holds) = judged.unzip();
        Self { slack, holds }
    }

    /// Number of verdicts that hold.
    pub(crate) fn held(&self) -> usize {
        self.holds.iter().filter(|holds| **holds).count()
    }

    /// Sum of what the verdicts lack to their thresholds, with a little to spare (m).
    pub(super) fn lack(&self) -> f64 {
        self.slack.iter().map(|slack| (SPARE - slack).max(0.0)).sum()
    }

    /// The least slack of the verdicts that hold (m).
    pub(super) fn least_slack(&self) -> f64 {
        let held = self.slack.iter().zip(&self.holds).filter(|(_, holds)| **holds);
        held.map(|(slack, _)| *slack).fold(f64::INFINITY, f64::min)
    }

    /// The places of the verdicts that do not hold.
    pub(super) fn missed(&self) -> impl Iterator<Item = usize> {
        self.holds.iter().enumerate().filter(|(_, holds)| !**holds).map(|(place, _)| place)
    }

    /// Which verdicts are worse, `Less`, or better: where the verdict at `wanted` holds, or lacks less; then where more
    /// verdicts hold; then where less is lacking.
    pub(super) fn compare(&self, other: &Self, wanted: Option<usize>) -> Ordering {
        let wanted = wanted.map_or(Ordering::Equal, |place| {
            // Beyond its threshold no verdict is better than another.
            self.slack[place].min(SPARE).total_cmp(&other.slack[place].min(SPARE))
        });
        wanted.then(self.held().cmp(&other.held())).then_with(|| other.lack().total_cmp(&self.lack()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdicts(slack: &[f64]) -> Verdicts {
        Verdicts { slack: slack.to_vec(), holds: slack.iter().map(|slack| *slack > 0.0).collect() }
    }

    #[test]
    fn more_verdicts_come_before_lesser_distances_and_a_wanted_one_before_both() {
        let (many, few) = (verdicts(&[0.01, 0.01, -0.02]), verdicts(&[-1e-3, -1e-3, 0.01]));
        assert_eq!(many.compare(&few, None), Ordering::Greater);
        assert_eq!(many.compare(&few, Some(2)), Ordering::Less);
        let nearer = verdicts(&[0.01, 0.01, -0.01]);
        assert_eq!(nearer.compare(&many, None), Ordering::Greater);
        assert_eq!((many.held(), many.missed().collect::<Vec<_>>()), (2, vec![2]));
    }
}
