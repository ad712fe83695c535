//! Takes back what a candidate changes without need, and finds the least single change that makes a verdict true.

use super::candidate::Candidate;
use super::candidate_pool::{CandidatePool, Judged, as_it_is};
use super::open_number::{OPEN_COUNT, OPEN_NUMBERS};
use super::verdicts::SPARE;

/// Steps from a value to either end of the plausible range, and beyond the range by as much again.
const STEPS: i32 = 10;

/// A change of one number that makes a verdict true.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SingleChange {
    /// Place of the number in [`OPEN_NUMBERS`].
    pub open: usize,
    /// Value that the number has then, in grains.
    pub grains: i32,
    /// Whether a plausible body or walk has it.
    pub is_plausible: bool,
    /// The places of the verdicts that are lost thereby.
    pub lost: Vec<usize>,
}

/// The candidate with each number as near to that of `start` as keeps its verdicts.
pub(super) fn with_least_change(pool: &mut CandidatePool, judged: Judged, start: &Candidate) -> Judged {
    let spare = judged.verdicts.least_slack().min(SPARE);
    let held = judged.verdicts.held();
    let mut best = judged;
    let mut keep = |best: &mut Judged, candidate: Candidate| {
        let is_good = |other: &Judged| other.verdicts.held() >= held && other.verdicts.least_slack() >= spare;
        let kept = pool.judge(&[candidate], as_it_is).pop().and_then(Result::ok).filter(is_good);
        let is_kept = kept.is_some();
        if let Some(kept) = kept {
            *best = kept;
        }
        is_kept
    };
    let reading = Candidate { reading: start.reading, ..best.candidate };
    if best.candidate.reading != start.reading {
        keep(&mut best, reading);
    }
    for open in 0..OPEN_COUNT {
        let target = start.grains[open];
        let as_before = best.candidate.with(open, target);
        if best.candidate == as_before || keep(&mut best, as_before) {
            continue;
        }
        // Halves the way back until no grain is left.
        let mut refused = target;
        loop {
            let middle = i32::midpoint(best.candidate.grains[open], refused);
            if middle == refused || middle == best.candidate.grains[open] {
                break;
            }
            let candidate = best.candidate.with(open, middle);
            if !keep(&mut best, candidate) {
                refused = middle;
            }
        }
    }
    best
}

/// The single change that makes the verdict at `place` true and is least, as a share of the plausible range; one within
/// the range before one beyond it.
pub(super) fn single_change(
    pool: &mut CandidatePool,
    judged: &Judged,
    place: usize,
    freedom: &[bool; OPEN_COUNT],
) -> Option<SingleChange> {
    let mut least: Option<(bool, f64, SingleChange)> = None;
    for open in (0..OPEN_COUNT).filter(|open| freedom[*open]) {
        let number = OPEN_NUMBERS[open];
        let width = number.max - number.min;
        let own = judged.candidate.grains[open];
        for direction in [1, -1] {
            let step = (width / STEPS).max(1) * direction;
            let ends = number.reach();
            let grains = (1..=2 * STEPS).map(|count| own + step * count);
            let along: Vec<i32> = grains.filter(|grains| ends.contains(grains) && *grains > 0).collect();
            let candidates: Vec<Candidate> = along.iter().map(|grains| judged.candidate.with(open, *grains)).collect();
            let results = pool.judge(&candidates, as_it_is);
            let holds = |result: &Result<Judged, _>| result.as_ref().is_ok_and(|other| other.verdicts.holds[place]);
            let Some(first) = results.iter().position(holds) else { continue };
            // Between the last step without and the first with it.
            let (mut without, mut with) = (along[first] - step, along[first]);
            while (with - without).abs() > 1 {
                let middle = i32::midpoint(with, without);
                let result = pool.judge(&[judged.candidate.with(open, middle)], as_it_is).pop();
                if result.as_ref().is_some_and(holds) { with = middle } else { without = middle }
            }
            let Some(Ok(changed)) = pool.judge(&[judged.candidate.with(open, with)], as_it_is).pop() else { continue };
            let lost = changed.verdicts.missed().filter(|missed| judged.verdicts.holds[*missed]).collect();
            let is_plausible = (number.min..=number.max).contains(&with);
            let share = f64::from((with - own).abs()) / f64::from(width);
            let change = SingleChange { open, grains: with, is_plausible, lost };
            let is_less =
                |(other, other_share, _): &(bool, f64, SingleChange)| (is_plausible, -share) > (*other, -*other_share);
            if least.as_ref().is_none_or(is_less) {
                least = Some((is_plausible, share, change));
            }
        }
    }
    least.map(|(_, _, change)| change)
}
