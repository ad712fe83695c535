//! What a search found, for people and as JSON.

use std::fmt::{self, Display};

use serde::Serialize;

use super::base::SearchBase;
use super::candidate::Candidate;
use super::least_change::SingleChange;
use super::open_number::OPEN_NUMBERS;
use super::verdicts::Verdicts;
use crate::table::number;
use crate::{RAMPS, Reading};

/// What a search found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SearchReport {
    seed: u64,
    candidates_tried: usize,
    candidates_that_cannot_walk: usize,
    verdicts_stated: usize,
    verdicts_before: usize,
    /// With a heel of 8 cm and T = 0.55 s, and all else as before.
    verdicts_of_heel_80_mm_and_550_ms: usize,
    verdicts_found: usize,
    /// What all missed verdicts together lack with the best candidate, before it was simplified.
    least_lack_mm: f64,
    mechanism: String,
    turn_ramp: &'static str,
    extension_ramp: &'static str,
    /// All open numbers; those that are as before, too.
    numbers: Vec<FoundNumber>,
    verdicts: Vec<FoundVerdict>,
    missed: Vec<MissedVerdict>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct FoundNumber {
    name: &'static str,
    before: f64,
    found: f64,
    plausible: [f64; 2],
    basis: &'static str,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct FoundVerdict {
    figure: u64,
    paper_verdict: &'static str,
    /// How far the margin is on the paper's side of the threshold; negative where the verdict is another one.
    slack_before_mm: f64,
    slack_found_mm: f64,
    agrees_before: bool,
    agrees: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct MissedVerdict {
    figure: u64,
    lacks_mm: f64,
    /// The most verdicts that hold together with this one, with any plausible candidate that was tried.
    most_verdicts_with_it: Option<usize>,
    /// The figures that are missed by the candidate with which this one and most others hold.
    missed_with_it: Vec<u64>,
    single_change: Option<NeededChange>,
}

/// The least change of one number that makes a verdict true.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct NeededChange {
    name: &'static str,
    value: f64,
    is_plausible: bool,
    loses_figures: Vec<u64>,
}

/// What a search has to tell of.
pub(super) struct Outcome<'s> {
    pub base: &'s SearchBase,
    pub claim: &'s Verdicts,
    pub candidate: &'s Candidate,
    pub verdicts: &'s Verdicts,
    pub changes: &'s [(usize, Option<SingleChange>)],
    pub most_with: &'s [Option<Verdicts>],
    pub least_lack: f64,
}

impl SearchReport {
    pub(super) fn new(outcome: &Outcome, seed: u64, tried: usize, unusable: usize) -> Self {
        let Outcome { base, claim, candidate, verdicts, changes, most_with, least_lack } = *outcome;
        let figure = |place: &usize| base.scenarios[*place].figure;
        let numbers = OPEN_NUMBERS.iter().enumerate().map(|(open, number)| FoundNumber {
            name: number.name,
            before: number.value(base.nearest.grains[open]),
            found: number.value(candidate.grains[open]),
            plausible: number.range(),
            basis: number.basis,
        });
        let each = base.scenarios.iter().enumerate().map(|(place, scenario)| FoundVerdict {
            figure: scenario.figure,
            paper_verdict: scenario.paper_verdict.text(),
            slack_before_mm: base.before.slack[place] * 1e3,
            slack_found_mm: verdicts.slack[place] * 1e3,
            agrees_before: base.before.holds[place],
            agrees: verdicts.holds[place],
        });
        let missed = changes.iter().map(|(place, change)| MissedVerdict {
            figure: figure(place),
            lacks_mm: -verdicts.slack[*place] * 1e3,
            most_verdicts_with_it: most_with[*place].as_ref().map(Verdicts::held),
            missed_with_it: most_with[*place].iter().flat_map(Verdicts::missed).map(|place| figure(&place)).collect(),
            single_change: change.as_ref().map(|change| NeededChange {
                name: OPEN_NUMBERS[change.open].name,
                value: OPEN_NUMBERS[change.open].value(change.grains),
                is_plausible: change.is_plausible,
                loses_figures: change.lost.iter().map(figure).collect(),
            }),
        });
        let Reading { turn, extension } = candidate.reading;
        let ramp = |kind| RAMPS.iter().find(|(_, known)| *known == kind).map_or("", |(name, _)| *name);
        Self {
            seed,
            candidates_tried: tried,
            candidates_that_cannot_walk: unusable,
            verdicts_stated: base.scenarios.len(),
            verdicts_before: base.before.held(),
            verdicts_of_heel_80_mm_and_550_ms: claim.held(),
            verdicts_found: verdicts.held(),
            least_lack_mm: least_lack * 1e3,
            mechanism: base.mechanisms[candidate.mechanism].name.clone(),
            turn_ramp: ramp(turn),
            extension_ramp: ramp(extension),
            numbers: numbers.collect(),
            verdicts: each.collect(),
            missed: missed.collect(),
        }
    }

    /// Number of stated verdicts that hold with what was found.
    pub fn verdicts_found(&self) -> usize {
        self.verdicts_found
    }

    /// The figures whose verdicts do not hold with what was found.
    pub fn missed_figures(&self) -> impl Iterator<Item = u64> {
        self.missed.iter().map(|missed| missed.figure)
    }
}

impl Display for SearchReport {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let all = self.verdicts_stated;
        writeln!(
            out,
            "seed {}: {} candidates tried, {} of them cannot walk",
            self.seed, self.candidates_tried, self.candidates_that_cannot_walk
        )?;
        writeln!(out, "as configured:           {} of {all} stated verdicts agree", self.verdicts_before)?;
        writeln!(
            out,
            "heel 8 cm, T = 0.55 s:   {} of {all}, all else as configured",
            self.verdicts_of_heel_80_mm_and_550_ms
        )?;
        writeln!(
            out,
            "found:                   {} of {all}; what is missed lacks {} mm at least, or more with fewer changes\n",
            self.verdicts_found,
            number(self.least_lack_mm, 1)
        )?;
        writeln!(out, "{}, turn {}, extension {}, and:\n", self.mechanism, self.turn_ramp, self.extension_ramp)?;
        writeln!(out, "{:<18}{:>8}{:>8}  plausible", "", "before", "found")?;
        for FoundNumber { name, before, found, plausible: [min, max], basis } in &self.numbers {
            let changed = if before == found { "" } else { " *" };
            writeln!(out, "{name:<18}{before:>8}{found:>8}  {min} … {max}: {basis}{changed}")?;
        }
        writeln!(out, "\nfig  paper  before [mm]  found [mm]  agree?")?;
        for verdict in &self.verdicts {
            let agreement = match (verdict.agrees_before, verdict.agrees) {
                (true, true) => "yes",
                (false, true) => "yes, now",
                (true, false) => "NO, not any more",
                (false, false) => "NO",
            };
            writeln!(
                out,
                "{:>3}  {:<5}  {:>11}  {:>10}  {agreement}",
                verdict.figure,
                verdict.paper_verdict,
                number(verdict.slack_before_mm, 1),
                number(verdict.slack_found_mm, 1),
            )?;
        }
        writeln!(out, "Millimetres of margin on the paper's side of the edge; negative: on the other side.")?;
        self.missed.iter().try_for_each(|missed| write!(out, "\n{missed}"))
    }
}

impl Display for MissedVerdict {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "Figure {} lacks {} mm. ", self.figure, number(self.lacks_mm, 1))?;
        match &self.single_change {
            Some(NeededChange { name, value, is_plausible, loses_figures }) => {
                let plausible = if *is_plausible { "" } else { ", which is not plausible" };
                write!(out, "The least single change: {name} {value}{plausible}; ")?;
                let figures: Vec<String> = loses_figures.iter().map(u64::to_string).collect();
                match figures.len() {
                    0 => write!(out, "it loses no other verdict. ")?,
                    _ => write!(out, "it loses figures {}. ", figures.join(", "))?,
                }
            }
            None => write!(out, "No single change within or near the plausible ranges makes it true. ")?,
        }
        match self.most_verdicts_with_it {
            Some(most) => {
                let figures: Vec<String> = self.missed_with_it.iter().map(u64::to_string).collect();
                let missed = figures.join(", ");
                write!(out, "With it, at most {most} verdicts hold of any candidate tried, without those of {missed}.")
            }
            None => write!(out, "It holds with no candidate tried."),
        }
    }
}
