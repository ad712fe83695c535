//! Tries candidates in batches, on several cores, and keeps the best: the same seed tries the same candidates, whatever
//! the number of cores.

use std::cmp::Ordering;
use std::thread;

use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::base::SearchBase;
use super::candidate::Candidate;
use super::error::SearchError;
use super::freedom::Freedom;
use super::open_number::{OPEN_COUNT, OPEN_NUMBERS, SOLE_COUNT};
use super::verdicts::Verdicts;
use crate::{RAMPS, Reading};

/// Candidates that are drawn before any of them is judged: more than any machine has cores for, so that their number
/// does not matter.
const BATCH: usize = 24;
/// How many of the best are varied further.
const KEPT: usize = 10;
/// Share of the candidates that are drawn from anywhere, not beside one of the best.
const ANYWHERE: f64 = 0.15;
/// Sweeps over the edges of the sole.
const SWEEPS: usize = 2;

/// A candidate with its verdicts.
#[derive(Clone, Debug)]
pub(super) struct Judged {
    pub candidate: Candidate,
    pub verdicts: Verdicts,
}

/// Everything that was tried so far.
pub(super) struct CandidatePool<'s> {
    pub base: &'s SearchBase,
    freedom: &'s Freedom,
    threads: usize,
    random: ChaCha8Rng,
    /// Number of candidates that were tried.
    pub tried: usize,
    /// Number of those that cannot walk.
    pub unusable: usize,
    /// For each verdict, the verdicts of the plausible candidate with which it and most others hold.
    pub most_with: Vec<Option<Verdicts>>,
    progress: &'s mut dyn FnMut(usize),
}

impl<'s> CandidatePool<'s> {
    /// A pool that nothing was drawn from. `progress` is told the number of candidates that were tried.
    pub(super) fn new(
        base: &'s SearchBase,
        freedom: &'s Freedom,
        threads: usize,
        seed: u64,
        progress: &'s mut dyn FnMut(usize),
    ) -> Self {
        let most_with = vec![None; base.scenarios.len()];
        let random = ChaCha8Rng::seed_from_u64(seed);
        Self { base, freedom, threads: threads.max(1), random, tried: 0, unusable: 0, most_with, progress }
    }

    /// Varies the candidates `from`, and returns the best of `count` with them, by the verdict `wanted` and by the
    /// number of verdicts.
    ///
    /// # Errors
    /// No candidate can walk: the error of the first one.
    pub(super) fn best(
        &mut self,
        from: &[Candidate],
        count: usize,
        wanted: Option<usize>,
    ) -> Result<Judged, SearchError> {
        let mut kept: Vec<Judged> = Vec::new();
        let mut first_error = None;
        let end = self.tried + count.max(from.len());
        let begin = self.tried;
        while self.tried < end {
            let size = BATCH.min(end - self.tried);
            let batch: Vec<Candidate> = if self.tried == begin {
                let drawn = from.len()..size;
                from.iter().copied().chain(drawn.map(|_| self.anywhere(from[0]))).take(size).collect()
            } else {
                let done = (self.tried - begin) as f64 / count as f64;
                (0..size).map(|_| self.beside_one_of(&kept, done)).collect()
            };
            for judged in self.judge(&batch, |base, candidate| fitted(base, self.freedom, candidate, wanted)) {
                match judged {
                    Ok(judged) if kept.iter().all(|other| other.candidate != judged.candidate) => kept.push(judged),
                    Ok(_) => {}
                    Err(error) => first_error = first_error.or(Some(error)),
                }
            }
            // The sort is stable: of equals the earlier stays.
            kept.sort_by(|one, other| other.verdicts.compare(&one.verdicts, wanted));
            kept.truncate(KEPT);
            if let (true, Some(error)) = (kept.is_empty(), first_error.take()) {
                return Err(error);
            }
        }
        Ok(kept.swap_remove(0))
    }

    /// Judges candidates on all cores, in their order.
    pub(super) fn judge(
        &mut self,
        batch: &[Candidate],
        judge: impl Fn(&SearchBase, Candidate) -> Result<Judged, SearchError> + Sync,
    ) -> Vec<Result<Judged, SearchError>> {
        let (base, threads) = (self.base, self.threads);
        let each = |first: usize| batch.iter().skip(first).step_by(threads).map(|one| judge(base, *one)).collect();
        let by_thread: Vec<Vec<_>> = thread::scope(|scope| {
            let running: Vec<_> = (1..threads).map(|first| scope.spawn(move || each(first))).collect();
            let own = each(0);
            let others = running
                .into_iter()
                .map(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
            [own].into_iter().chain(others).collect()
        });
        let mut by_thread: Vec<_> = by_thread.into_iter().map(Vec::into_iter).collect();
        let judged: Vec<_> = (0..batch.len()).filter_map(|place| by_thread[place % threads].next()).collect();
        self.tried += judged.len();
        for judged in &judged {
            match judged {
                Ok(judged) if judged.candidate.is_plausible() => note(&mut self.most_with, &judged.verdicts),
                Ok(_) => {}
                Err(_) => self.unusable += 1,
            }
        }
        (self.progress)(self.tried);
        judged
    }

    /// A number in 0 … 1, without 1.
    fn share(&mut self) -> f64 {
        (self.random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// One of so many things.
    fn one_of(&mut self, count: usize) -> usize {
        (self.share() * count as f64) as usize
    }

    /// A candidate from anywhere within what may vary.
    fn anywhere(&mut self, fixed: Candidate) -> Candidate {
        let mut candidate = fixed;
        for open in (0..OPEN_COUNT).filter(|open| self.freedom.numbers[*open]) {
            let number = OPEN_NUMBERS[open];
            candidate.grains[open] = number.min + self.one_of((number.max - number.min + 1) as usize) as i32;
        }
        self.with_another_reading(candidate, 0.5)
    }

    /// A candidate beside one of the best; the nearer, the more of the search is `done` (0 to 1).
    fn beside_one_of(&mut self, best: &[Judged], done: f64) -> Candidate {
        let chosen = best[self.one_of(best.len())].candidate;
        if self.share() < ANYWHERE {
            return self.anywhere(chosen);
        }
        let mut candidate = chosen;
        let reach = 0.3 * (1.0 - done) + 0.03;
        for open in (0..OPEN_COUNT).filter(|open| self.freedom.numbers[*open]) {
            let number = OPEN_NUMBERS[open];
            if self.share() < 0.35 {
                // The sum of two even distributions: small changes are likelier than great ones.
                let change = (self.share() + self.share() - 1.0) * reach * f64::from(number.max - number.min);
                let away = change.abs().ceil().copysign(change) as i32;
                candidate.grains[open] = (candidate.grains[open] + away).clamp(number.min, number.max);
            }
        }
        self.with_another_reading(candidate, 0.05)
    }

    /// With a probability, draws ramps and axes anew.
    fn with_another_reading(&mut self, candidate: Candidate, probability: f64) -> Candidate {
        let Candidate { mut mechanism, mut reading, .. } = candidate;
        if self.freedom.axes && self.share() < probability {
            mechanism = self.one_of(self.base.mechanisms.len());
        }
        if self.freedom.ramps && self.share() < probability {
            let [turn, extension] = std::array::from_fn(|_| RAMPS[self.one_of(RAMPS.len())].1);
            reading = Reading { turn, extension };
        }
        Candidate { mechanism, reading, ..candidate }
    }
}

/// The candidate with the best edges of the sole: its walk is computed once, for all of them.
fn fitted(
    base: &SearchBase,
    freedom: &Freedom,
    candidate: Candidate,
    wanted: Option<usize>,
) -> Result<Judged, SearchError> {
    let paths = base.paths(&candidate)?;
    let judged = |candidate: Candidate| {
        let verdicts = Verdicts::of_paths(&base.scenarios, &paths, &base.sole(&candidate));
        Judged { candidate, verdicts }
    };
    let mut best = judged(candidate);
    for _ in 0..SWEEPS {
        for edge in (0..SOLE_COUNT).filter(|edge| freedom.numbers[*edge]) {
            for grains in OPEN_NUMBERS[edge].min..=OPEN_NUMBERS[edge].max {
                let other = judged(best.candidate.with(edge, grains));
                if other.verdicts.compare(&best.verdicts, wanted) == Ordering::Greater {
                    best = other;
                }
            }
        }
    }
    Ok(best)
}

/// Judges a candidate as it is.
pub(super) fn as_it_is(base: &SearchBase, candidate: Candidate) -> Result<Judged, SearchError> {
    Ok(Judged { verdicts: base.verdicts(&candidate)?, candidate })
}

/// Notes which verdicts hold together with each.
fn note(most_with: &mut [Option<Verdicts>], verdicts: &Verdicts) {
    for (most, holds) in most_with.iter_mut().zip(&verdicts.holds) {
        if *holds && most.as_ref().is_none_or(|most| verdicts.held() > most.held()) {
            *most = Some(verdicts.clone());
        }
    }
}
