//! The summary of a walk, with both processes together.

use std::fmt;
use std::path::Path;

use node::request_queue::Tally;
use node::summary::{FaultSummary, counted};
use node::timing::TimingStats;
use plots::run_log::{Fall, Measures};
use plots::run_summary::{load_text, margin_text, most_loaded};
use serde::Serialize;

/// Summary of a walk; `summary.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct WalkSummary {
    /// Distance, heading, margin and falls.
    #[serde(flatten)]
    pub measures: Measures,
    /// What the controller was doing at the end.
    pub mode: String,
    /// The first fault that was latched while the plant ran; absent in JSON if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<FaultSummary>,
    /// How many requests got which verdict.
    pub requests: Tally,
    /// Simulated time (s).
    pub duration_s: f64,
    /// Seed of the sensors' noise and of the mass errors.
    pub seed: u64,
    /// The physics engine: `rust` or `mujoco`.
    pub plant: &'static str,
    /// What the floor is, in words: `a plane`, or the parts that make it other than that.
    pub floor: String,
    /// Name of the instance.
    pub instance: String,
    /// The clock: `realtime` or `lockstep`.
    pub clock: &'static str,
    /// Deadlines missed by controller and plant.
    pub deadline_misses: u64,
    /// How well the controller's loop kept time; `None` in lockstep.
    #[serde(rename = "kept_time")]
    pub timing: Option<TimingStats>,
    /// Hash of all setpoints, which is the same for the same bits; absent in JSON in real time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub setpoint_hash: Option<String>,
    /// Entries missing in the recording because its writers fell behind.
    pub log_gaps: u64,
    /// What went wrong beside a fall, one text each: the simulation became unstable, or the run could not be recorded.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub problems: Vec<String>,
    /// Simulated time over wall-clock time.
    pub real_time_factor: f64,
}

/// A summary with the folder that holds it, as it is printed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct SummaryInFolder<'a> {
    /// Folder of recording, summary and pictures.
    pub folder: &'a Path,
    /// The summary.
    #[serde(flatten)]
    pub summary: &'a WalkSummary,
}

impl fmt::Display for SummaryInFolder<'_> {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { folder, summary } = self;
        write!(out, "{summary}\nrun.mcap, summary.json and pictures, all on index.html, are in {}", folder.display())
    }
}

impl WalkSummary {
    /// Whether a fault that no reset has cleared stopped the robot.
    pub(crate) fn is_faulted(&self) -> bool {
        self.fault.as_ref().is_some_and(|fault| !fault.is_cleared())
    }
}

impl fmt::Display for WalkSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Measures { half_steps, distance_m, truth, estimated, falls, fall, .. } = self.measures;
        // Else it might be printed as -0.0.
        let heading_deg = (truth.unwrap_or(estimated).heading_deg * 10.0).round() / 10.0 + 0.0;
        let margin = margin_text(self.measures.least_margin.as_ref());
        let falls = if falls == 0 { "no fall".to_owned() } else { counted(falls as u64, "fall") };
        let half_steps = counted(half_steps, "half-step");
        write!(
            out,
            "{half_steps} in {:.1} s: {distance_m:.2} m, turned {heading_deg:+.1}°, least margin {margin}, {falls}",
            self.duration_s
        )?;
        writeln!(out, "{}", if self.is_faulted() { ", stopped by a fault" } else { "" })?;
        self.fault.as_ref().map_or(Ok(()), |fault| writeln!(out, "{fault}; at the end {}", self.mode))?;
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
        let mut also = Vec::new();
        also.extend(self.measures.zmp_error_rms_mm.map(|error| format!("ZMP error {error:.1} mm RMS")));
        if let Some(cost) = self.measures.cost_of_transport {
            let electrical = cost.electrical.map_or(String::new(), |cost| format!("{cost:.2} electrical, "));
            also.push(format!("cost of transport {electrical}{:.2} mechanical", cost.mechanical));
        }
        also.extend(most_loaded(&self.measures.joint_loads).map(load_text));
        if !also.is_empty() {
            writeln!(out, "{}", also.join("; "))?;
        }
        if self.floor != "a plane" {
            writeln!(out, "the floor: {}", self.floor)?;
        }
        writeln!(out, "{}", self.requests)?;
        let Self { real_time_factor, deadline_misses, log_gaps, timing, .. } = self;
        let (misses, gaps) = (counted(*deadline_misses, "deadline"), counted(*log_gaps, "report"));
        write!(out, "{real_time_factor:.1} × real time, {misses} missed, {gaps} dropped")?;
        self.setpoint_hash.as_ref().map_or(Ok(()), |hash| write!(out, ", setpoints {hash}"))?;
        timing.map_or(Ok(()), |timing| write!(out, "\nthe controller's {timing}"))?;
        self.problems.iter().try_for_each(|problem| write!(out, "\n{problem}"))
    }
}
