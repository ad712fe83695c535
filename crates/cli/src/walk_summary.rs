//! The summary of a walk, with both processes together.

use std::fmt;

use node::request_queue::Tally;
use node::timing::TimingStats;
use plots::run_log::{Fall, Measures};
use serde::Serialize;

/// Summary of a walk; `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct WalkSummary {
    /// Distance, heading, margin and falls.
    #[serde(flatten)]
    pub measures: Measures,
    /// How many requests got which verdict.
    pub requests: Tally,
    /// Simulated time (s).
    pub duration_s: f64,
    /// Seed of the sensors' noise and of the mass errors.
    pub seed: u64,
    /// The physics engine: `rust` or `mujoco`.
    pub plant: &'static str,
    /// Name of the instance.
    pub instance: String,
    /// The clock: `realtime` or `lockstep`.
    pub clock: &'static str,
    /// Deadlines missed by controller and plant.
    pub deadline_misses: u64,
    /// How well the controller's loop kept time; `None` in lockstep.
    #[serde(rename = "kept_time")]
    pub timing: Option<TimingStats>,
    /// Entries missing in the recording because its writers fell behind.
    pub log_gaps: u64,
    /// What went wrong beside a fall, one text each: the simulation became unstable, or the run could not be recorded.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub problems: Vec<String>,
    /// Simulated time over wall-clock time.
    pub real_time_factor: f64,
}

impl fmt::Display for WalkSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Measures { half_steps, distance_m, heading_deg, min_margin_mm, falls, fall } = self.measures;
        let margin = min_margin_mm.map_or("unknown".to_owned(), |margin| format!("{:.0} mm", margin.round() + 0.0));
        let falls = match falls {
            0 => "no fall".to_owned(),
            1 => "1 fall".to_owned(),
            falls => format!("{falls} falls"),
        };
        writeln!(
            out,
            "{half_steps} half-steps in {:.1} s: {distance_m:.2} m, turned {heading_deg:+.1}°, least margin {margin}, \
             {falls}",
            self.duration_s
        )?;
        if let Some(Fall { time_s, unavoidable_s, half_step }) = fall {
            write!(out, "it fell at {time_s:.2} s in half-step {half_step}")?;
            match unavoidable_s {
                Some(since) => {
                    writeln!(
                        out,
                        ", and could not be saved from {since:.2} s on: the capture point had left the soles"
                    )?;
                }
                None => writeln!(out, " with its capture point over the soles")?,
            }
        }
        writeln!(out, "{}", self.requests)?;
        let Self { real_time_factor, deadline_misses, log_gaps, timing, .. } = self;
        write!(
            out,
            "{real_time_factor:.1} × real time, {deadline_misses} deadlines missed, {log_gaps} reports dropped"
        )?;
        timing.map_or(Ok(()), |timing| write!(out, "\nthe controller's {timing}"))?;
        self.problems.iter().try_for_each(|problem| write!(out, "\n{problem}"))
    }
}
