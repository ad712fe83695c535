//! Summaries that the processes print at their end.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::request_queue::Tally;
use crate::timing::TimingStats;

/// Summary of a run of the controller's process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ControllerSummary {
    /// Control periods since the start.
    pub ticks: u64,
    /// Half-steps completed.
    pub half_steps: u64,
    /// The mode after the last tick; empty if the loop never began.
    pub mode: String,
    /// How many requests got which verdict.
    pub requests: Tally,
    /// Deadlines missed.
    pub deadline_misses: u64,
    /// How well the loop kept time; `None` in lockstep.
    #[serde(rename = "kept_time")]
    pub timing: Option<TimingStats>,
    /// Entries missing in the recording because its writer fell behind.
    pub log_gaps: u64,
    /// Why the run was not recorded to its end; `None` if it was.
    pub record_error: Option<String>,
}

/// Summary of a run of the plant's process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlantSummary {
    /// Control periods since the start.
    pub ticks: u64,
    /// When the robot fell (s).
    pub fell_at_s: Option<f64>,
    /// How the simulation became unstable, and which settings to look at; `None` if it did not.
    pub unstable: Option<String>,
    /// Why the run was not recorded to its end; `None` if it was.
    pub record_error: Option<String>,
    /// Deadlines missed.
    pub deadline_misses: u64,
    /// Entries missing in the recording because its writer fell behind.
    pub log_gaps: u64,
    /// Wall-clock time from the first step to the last (s).
    pub wall_s: f64,
}

impl fmt::Display for ControllerSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { ticks, half_steps, mode, requests, deadline_misses, timing, log_gaps, record_error } = self;
        let mode = if mode.is_empty() { "never started" } else { mode };
        write!(
            out,
            "{ticks} ticks, {half_steps} half-steps, {mode}; {requests}; {deadline_misses} deadlines missed, \
             {log_gaps} \
             reports dropped"
        )?;
        timing.map_or(Ok(()), |timing| write!(out, "; {timing}"))?;
        record_error.as_ref().map_or(Ok(()), |error| write!(out, "\nnot recorded to the end: {error}"))
    }
}

impl fmt::Display for PlantSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{} ticks, {} deadlines missed, ", self.ticks, self.deadline_misses)?;
        match self.fell_at_s {
            None => write!(out, "no fall"),
            Some(time) => write!(out, "fell at {time:.2} s"),
        }?;
        self.unstable.as_ref().map_or(Ok(()), |unstable| write!(out, "\n{unstable}"))?;
        self.record_error.as_ref().map_or(Ok(()), |error| write!(out, "\nnot recorded to the end: {error}"))
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "requests: {} accepted, {} limited, {} refused", self.accepted, self.limited, self.refused)
    }
}
