//! A recorded run, read to be drawn.

use std::path::Path;

use config::Config;
use model::Mechanism;
use node::configuration::MECHANISM;
use plots::picture::FloorHeights;
use plots::run_log::{RunLog, TimeWindow};
use plots::run_summary::RunSummary;
use record::{Provenance, provenance_of};

use crate::error::CliError;
use crate::recorded_floor::{floor_of, recorded_ground};

/// Less cannot be drawn (s).
const SPAN_MIN: f64 = 0.02;

/// A recorded run with everything that pictures need.
pub(crate) struct PlottedRun {
    /// The run as the user names it.
    pub(crate) name: String,
    /// What it began with.
    pub(crate) provenance: Provenance,
    /// The robot.
    pub(crate) mechanism: Mechanism,
    /// The floor on which it walked.
    pub(crate) floor: FloorHeights,
    /// The log, or the part of it that is drawn.
    pub(crate) log: RunLog,
    /// The summary of the whole run.
    pub(crate) summary: RunSummary,
}

impl PlottedRun {
    /// Reads a run, given by its recording or its folder, and of it the part that is to be drawn.
    ///
    /// # Errors
    /// There is no recording, it has no mechanism, or nothing of it can be drawn.
    pub(crate) fn read(run: &Path, window: Option<TimeWindow>) -> Result<Self, CliError> {
        let provenance = provenance_of(run)?;
        let name = run.display().to_string();
        let text = provenance.file(MECHANISM);
        let text = text.ok_or_else(|| CliError::bad_input(format!("{name}: has no {MECHANISM} attached")))?;
        let mechanism = Mechanism::from_toml(text, &format!("{name}: {MECHANISM}")).map_err(CliError::bad_input)?;
        let mut log = RunLog::read_in_detail(run, window)?;
        let notes = log.notes.join("; ");
        let Some((first, last)) = log.span() else {
            return Err(CliError::bad_input(format!("{name}: holds nothing to draw, no report and no state: {notes}")));
        };
        if last - first < SPAN_MIN {
            let notes = if notes.is_empty() { notes } else { format!(": {notes}") };
            return Err(CliError::bad_input(format!(
                "{name}: is too short to be drawn: it holds {:.0} ms of a run{notes}",
                (last - first) * 1e3
            )));
        }
        let floor = recorded_ground(&provenance).unwrap_or_else(|error| {
            log.notes.push(format!("the floor is drawn as a plane: {error}"));
            None
        });
        let floor = floor.map_or(FloorHeights::PLANE, floor_of);
        let summary = RunSummary::of(&log, &mechanism);
        if let Some(window) = window {
            log = log.within(window);
            if log.span().is_none_or(|(first, last)| last - first < SPAN_MIN) {
                let TimeWindow { from, to } = window;
                return Err(CliError::bad_input(format!(
                    "{name}: has nothing to draw from {from} to {to} s: the run was recorded from {first:.3} to \
                     {last:.3} s"
                )));
            }
        }
        Ok(Self { name, provenance, mechanism, floor, log, summary })
    }
}
