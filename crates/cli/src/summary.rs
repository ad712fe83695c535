//! Summaries: what a process, and a whole walk, amounted to.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::inbox::Tally;
use crate::loop_times::KeptTime;
use crate::run_log::{Fall, Measures};

/// What the controller's process has to say at its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ControllerSummary {
    /// Control periods.
    pub ticks: u64,
    /// Half-steps completed.
    pub half_steps: u64,
    /// What it was doing at last; empty if it never began.
    pub mode: String,
    /// What became of the requests.
    pub requests: Tally,
    /// Deadlines missed.
    pub deadline_misses: u64,
    /// How its loop kept time, if it ran in real time.
    pub kept_time: Option<KeptTime>,
    /// Ticks that the log lacks because its writer fell behind.
    pub log_gaps: u64,
}

/// What the plant's process has to say at its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlantSummary {
    /// Control periods.
    pub ticks: u64,
    /// When the robot fell [s].
    pub fell_at_s: Option<f64>,
    /// Deadlines missed.
    pub deadline_misses: u64,
    /// Rows that the log lacks because its writer fell behind.
    pub log_gaps: u64,
    /// How long it took [s].
    pub wall_s: f64,
}

/// What a walk amounted to; `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WalkSummary {
    /// What was walked.
    #[serde(flatten)]
    pub measures: Measures,
    /// What became of the requests.
    pub requests: Tally,
    /// Walked time [s].
    pub duration_s: f64,
    /// Of the sensors' noise.
    pub seed: u64,
    /// Who simulated the robot: `rust` or `mujoco`.
    pub plant: &'static str,
    /// The instance's name.
    pub instance: String,
    /// By which clock: `realtime` or `lockstep`.
    pub clock: &'static str,
    /// Deadlines missed by controller and plant.
    pub deadline_misses: u64,
    /// How the controller's loop kept time, in real time.
    pub kept_time: Option<KeptTime>,
    /// Rows that the logs lack because their writers fell behind.
    pub log_gaps: u64,
    /// Walked time over the time it took.
    pub real_time_factor: f64,
}

impl fmt::Display for ControllerSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { ticks, half_steps, mode, requests, deadline_misses, kept_time, log_gaps } = self;
        let mode = if mode.is_empty() { "never began" } else { mode };
        write!(
            out,
            "{ticks} ticks, {half_steps} half-steps, {mode}; {requests}; {deadline_misses} deadlines missed, {log_gaps} \
             reports dropped"
        )?;
        kept_time.map_or(Ok(()), |kept_time| write!(out, "; {kept_time}"))
    }
}

impl fmt::Display for PlantSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{} ticks, {} deadlines missed, ", self.ticks, self.deadline_misses)?;
        match self.fell_at_s {
            None => write!(out, "no fall"),
            Some(time) => write!(out, "fell at {time:.2} s"),
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "requests: {} accepted, {} limited, {} refused", self.accepted, self.limited, self.refused)
    }
}

impl fmt::Display for WalkSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Measures { half_steps, distance_m, heading_deg, min_margin_mm, falls, fall } = self.measures;
        let margin = min_margin_mm.map_or("unknown".to_owned(), |margin| format!("{margin:.0} mm"));
        let falls = match falls {
            0 => "no fall".to_owned(),
            1 => "1 fall".to_owned(),
            falls => format!("{falls} falls"),
        };
        writeln!(
            out,
            "{half_steps} half-steps in {:.1} s: {distance_m:.2} m, turned {heading_deg:+.1}°, least margin {margin}, {falls}",
            self.duration_s
        )?;
        if let Some(Fall { time_s, unavoidable_s, half_step }) = fall {
            write!(out, "it fell at {time_s:.2} s in half-step {half_step}")?;
            match unavoidable_s {
                Some(since) => {
                    writeln!(out, ", unavoidably from {since:.2} s on: the capture point had left the soles")?
                }
                None => writeln!(out, " with its capture point over the soles")?,
            }
        }
        writeln!(out, "{}", self.requests)?;
        let Self { real_time_factor, deadline_misses, log_gaps, kept_time, .. } = self;
        write!(
            out,
            "{real_time_factor:.1} × real time, {deadline_misses} deadlines missed, {log_gaps} reports dropped"
        )?;
        kept_time.map_or(Ok(()), |kept_time| write!(out, "\nthe controller's {kept_time}"))
    }
}
