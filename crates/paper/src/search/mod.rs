//! Searches for one plausible body and one reading that make as many stated verdicts true as possible.

mod base;
mod candidate;
mod candidate_pool;
mod error;
mod files;
mod freedom;
mod least_change;
mod open_number;
mod report;
mod toml_values;
mod verdicts;

pub use base::SearchBase;
pub use candidate::Candidate;
pub use error::SearchError;
pub use files::{FileText, FoundFiles};
pub use freedom::Freedom;
pub use open_number::{OPEN_NUMBERS, Open, OpenNumber};
pub use report::SearchReport;
pub(crate) use verdicts::Verdicts;

use candidate_pool::{CandidatePool, Judged, as_it_is};
use least_change::{SingleChange, single_change, with_least_change};
use report::Outcome;

/// How to search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SearchOptions {
    /// What the search may change.
    pub freedom: Freedom,
    /// Seed of the candidates.
    pub seed: u64,
    /// Number of candidates that are drawn; some tens or hundreds more are tried to simplify and explain what is found.
    pub candidates: usize,
    /// Number of threads that judge candidates: no result depends on it.
    pub threads: usize,
}

/// The heel (m) and the duration (s) of a body of which it was said that 37 verdicts hold.
const CLAIM: [(Open, f64); 2] = [(Open::Heel, 0.08), (Open::Duration, 0.55)];
/// Share of the candidates that are to make as many verdicts true as possible; the others are to make those true that
/// are left.
const SHARE_FOR_ALL: f64 = 0.6;

/// Searches, and returns the candidate with which most verdicts hold, and what it found. The same inputs give the same
/// bits. `progress` is told the number of candidates that were tried.
///
/// # Errors
/// The robot of the folder itself cannot be made anew.
pub fn search(
    base: &SearchBase,
    options: &SearchOptions,
    progress: &mut dyn FnMut(usize),
) -> Result<(Candidate, SearchReport), SearchError> {
    let SearchOptions { freedom, seed, candidates, threads } = options;
    let mut pool = CandidatePool::new(base, freedom, *threads, *seed, progress);
    let claimed = CLAIM.into_iter().fold(base.nearest, |candidate, (open, value)| {
        candidate.with(open as usize, OPEN_NUMBERS[open as usize].nearest(value))
    });
    let claim = as_it_is(base, claimed)?;

    let for_all = ((*candidates as f64 * SHARE_FOR_ALL) as usize).max(1);
    let mut best = pool.best(&[base.nearest], for_all, None)?;
    // Each verdict that is left becomes the aim of a search of its own.
    let left: Vec<usize> = best.verdicts.missed().collect();
    let found = best.candidate;
    for place in &left {
        let each = (candidates.saturating_sub(for_all) / left.len()).max(1);
        let other = pool.best(&[found], each, Some(*place))?;
        if other.verdicts.compare(&best.verdicts, None).is_gt() {
            best = other;
        }
    }
    let least_lack = best.verdicts.lack();
    let best = with_least_change(&mut pool, best, &base.nearest);
    let missed: Vec<usize> = best.verdicts.missed().collect();
    let changes = missed.into_iter().map(|place| (place, single_change(&mut pool, &best, place, &freedom.numbers)));
    let changes: Vec<(usize, Option<SingleChange>)> = changes.collect();
    let Judged { candidate, verdicts } = best;
    let outcome = Outcome {
        base,
        claim: &claim.verdicts,
        candidate: &candidate,
        verdicts: &verdicts,
        changes: &changes,
        most_with: &pool.most_with,
        least_lack,
    };
    let report = SearchReport::new(&outcome, *seed, pool.tried, pool.unusable);
    Ok((candidate, report))
}
