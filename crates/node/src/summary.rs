//! Summaries that the processes print at their end.

use std::fmt;

use interface::LatchedFault;
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
    /// The first fault that was latched, and after a reset the next one; absent in JSON if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fault: Option<FaultSummary>,
    /// How many requests got which verdict.
    pub requests: Tally,
    /// Deadlines missed.
    pub deadline_misses: u64,
    /// How well the loop kept time; `None` in lockstep.
    #[serde(rename = "kept_time")]
    pub timing: Option<TimingStats>,
    /// Hash of all setpoints, which is the same for the same bits; `None` in real time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub setpoint_hash: Option<String>,
    /// Entries missing in the recording because its writer fell behind.
    pub log_gaps: u64,
    /// Why the run was not recorded to its end; `None` if it was.
    pub record_error: Option<String>,
}

/// A fault that stopped the robot, as text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaultSummary {
    /// What was wrong.
    pub fault: String,
    /// When it was latched: time since the controller's first tick (s).
    pub time_s: f64,
    /// When a reset cleared it, likewise (s); absent in JSON if none did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cleared_at_s: Option<f64>,
}

impl FaultSummary {
    /// The summary of a fault that was latched, and of when a reset cleared it (s).
    pub fn new(latched: &LatchedFault, cleared: Option<f64>) -> Self {
        let rounded = |time: f64| (time * 1e3).round() / 1e3;
        Self { fault: latched.text(), time_s: rounded(latched.time), cleared_at_s: cleared.map(rounded) }
    }

    /// Whether a reset has cleared it.
    pub fn is_cleared(&self) -> bool {
        self.cleared_at_s.is_some()
    }
}

impl fmt::Display for FaultSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "fault at {:.2} s: {}", self.time_s, self.fault)?;
        self.cleared_at_s.map_or(Ok(()), |cleared| write!(out, ", cleared by a reset at {cleared:.2} s"))
    }
}

/// Summary of a run of the plant's process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlantSummary {
    /// Control periods since the start.
    pub ticks: u64,
    /// What the floor is, in words.
    pub floor: String,
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
    /// Control periods without a new setpoint.
    pub setpoints_repeated: u64,
    /// Setpoints that were replaced before the plant used them.
    pub setpoints_lost: u64,
}

impl fmt::Display for ControllerSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { ticks, half_steps, mode, fault, requests, deadline_misses, timing, log_gaps, .. } = self;
        let mode = if mode.is_empty() { "never started" } else { mode };
        write!(out, "{}, {}, {mode}", counted(*ticks, "tick"), counted(*half_steps, "half-step"))?;
        fault.as_ref().map_or(Ok(()), |fault| write!(out, " ({fault})"))?;
        let (misses, gaps) = (counted(*deadline_misses, "deadline"), counted(*log_gaps, "report"));
        write!(out, "; {requests}; {misses} missed, {gaps} dropped")?;
        timing.map_or(Ok(()), |timing| write!(out, "; {timing}"))?;
        self.setpoint_hash.as_ref().map_or(Ok(()), |hash| write!(out, "; setpoints {hash}"))?;
        self.record_error.as_ref().map_or(Ok(()), |error| write!(out, "\nnot recorded to the end: {error}"))
    }
}

impl fmt::Display for PlantSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { ticks, deadline_misses, setpoints_repeated, setpoints_lost, .. } = self;
        let (ticks, misses) = (counted(*ticks, "tick"), counted(*deadline_misses, "deadline"));
        let repeated = counted(*setpoints_repeated, "setpoint");
        write!(out, "{ticks}, {misses} missed, {repeated} used again and {setpoints_lost} not at all, ")?;
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

/// A number of things: `1 tick`, `2 ticks`.
pub fn counted(number: u64, name: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {name}{plural}")
}

#[cfg(test)]
mod tests {
    use interface::Fault;

    use super::*;

    #[test]
    fn the_last_line_of_a_faulted_controller_names_fault_and_time() {
        let latched = LatchedFault { fault: Fault::MeasurementStale, time: 3.3004, cause: None };
        let summary = ControllerSummary {
            ticks: 9000,
            half_steps: 1,
            mode: "faulted".to_owned(),
            fault: Some(FaultSummary::new(&latched, None)),
            requests: Tally::default(),
            deadline_misses: 1,
            timing: None,
            setpoint_hash: Some("0x0123456789abcdef".to_owned()),
            log_gaps: 0,
            record_error: None,
        };
        assert_eq!(
            summary.to_string(),
            "9000 ticks, 1 half-step, faulted (fault at 3.30 s: no valid measurement has arrived for too long); \
             requests: 0 accepted, 0 limited, 0 refused; 1 deadline missed, 0 reports dropped; \
             setpoints 0x0123456789abcdef"
        );
        let json = serde_json::to_value(&summary).unwrap();
        assert_eq!(json["fault"]["time_s"], 3.3);
        assert_eq!(serde_json::from_value::<ControllerSummary>(json).unwrap(), summary);
    }
}
