//! What comes out with the numbers of a question.

use serde::Serialize;

use crate::search::Verdicts;
use crate::table::lean_text;
use crate::{PaperVerdict, Scenario};

/// What comes out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InstrumentAnswer {
    /// Number of stated verdicts that come out.
    pub agree: usize,
    /// All stated verdicts.
    pub verdicts: Vec<VerdictRow>,
    /// The figure that was asked for.
    pub drawn: Option<DrawnFigure>,
}

/// A stated verdict, and what comes out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct VerdictRow {
    /// Number of the figure in the paper.
    pub figure: u64,
    /// What walks in it.
    pub title: String,
    /// The lean of the paper, or nothing.
    pub lean: String,
    /// `in` or `out`, as the paper states.
    pub paper: &'static str,
    /// `in` or `out`, as it comes out.
    pub here: &'static str,
    /// Whether both are the same.
    pub agrees: bool,
    /// Least distance of the ZMP from the edge of the sole (mm): negative outside.
    pub margin_mm: f64,
}

/// A figure as a picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DrawnFigure {
    /// Its number in the paper.
    pub figure: u64,
    /// What it shows, in words.
    pub summary: String,
    /// A note on it, if there is one.
    pub note: Option<String>,
    /// Least distance of the ZMP from the edge of the sole (mm): negative outside.
    pub margin_mm: f64,
    /// The picture.
    pub svg: String,
}

impl InstrumentAnswer {
    /// The answer by the verdicts of scenarios, which all state one.
    pub(super) fn new(scenarios: &[Scenario], verdicts: &Verdicts, drawn: Option<DrawnFigure>) -> Self {
        let judged = scenarios.iter().zip(verdicts.slack.iter().zip(&verdicts.holds));
        let rows = judged.map(|(scenario, (slack, holds))| {
            let is_out = scenario.paper_verdict == PaperVerdict::Out;
            let here = if is_out == *holds { PaperVerdict::Out } else { PaperVerdict::In };
            VerdictRow {
                figure: scenario.figure,
                title: scenario.title.clone(),
                lean: scenario.lean.map_or(String::new(), |lean| lean_text(&lean, 1)),
                paper: scenario.paper_verdict.text(),
                here: here.text(),
                agrees: *holds,
                margin_mm: if is_out { -slack } else { *slack } * 1e3,
            }
        });
        Self { agree: verdicts.held(), verdicts: rows.collect(), drawn }
    }
}
