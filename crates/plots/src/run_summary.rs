//! A run in words.

use interface::Mode;
use model::Mechanism;
use serde::Serialize;

use crate::run_log::{Fall, FaultedSince, JointLoad, LeastMargin, Measures, RunLog};

/// A run in numbers, with what became of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunSummary {
    /// Recorded time (s).
    pub duration_s: f64,
    /// What the controller was doing at the end; `None` if it recorded nothing.
    pub mode: Option<&'static str>,
    /// When and by which fault the robot was stopped; absent in JSON if it never was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faulted: Option<FaultedSince>,
    /// Distance, heading, margin, falls and loads.
    #[serde(flatten)]
    pub measures: Measures,
}

impl RunSummary {
    /// The summary of a whole run.
    pub fn of(log: &RunLog, mechanism: &Mechanism) -> Self {
        Self {
            duration_s: log.span().map_or(0.0, |(first, last)| last - first),
            mode: log.controller.last().map(|row| row.mode),
            faulted: log.totals.faulted.clone(),
            measures: log.measures(mechanism),
        }
    }

    /// How the run ended, in words.
    pub fn outcome(&self) -> String {
        let fell = self
            .measures
            .fall
            .map(|Fall { time_s, half_step, .. }| format!("fell at {time_s:.2} s in half-step {half_step}"));
        let faulted = self.faulted.as_ref().map(|FaultedSince { time_s, faults }| {
            let faults = if faults.is_empty() { "a latched fault".to_owned() } else { faults.join("; ") };
            format!("stopped at {time_s:.2} s by a fault: {faults}")
        });
        let mode = self.mode.filter(|mode| ![Mode::Fallen, Mode::Faulted].map(Mode::text).contains(mode));
        let mode = mode.map(|mode| format!("{mode} at the end"));
        let told: Vec<String> = [fell, faulted, mode].into_iter().flatten().collect();
        if told.is_empty() { "no fall".to_owned() } else { told.join(", ") }
    }

    /// The lines of a table: what it is, and its value.
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let Measures { half_steps, distance_m, truth, estimated, zmp_error_rms_mm, .. } = self.measures;
        let heading_deg = truth.unwrap_or(estimated).heading_deg;
        let mut lines = vec![
            ("outcome", self.outcome()),
            ("recorded time", format!("{:.2} s", self.duration_s)),
            ("distance", format!("{distance_m:.2} m")),
            ("turned", format!("{:+.1}°", (heading_deg * 10.0).round() / 10.0 + 0.0)),
        ];
        if self.mode.is_some() {
            lines.insert(2, ("half-steps", half_steps.to_string()));
            lines.push(("least margin, off support changes", margin_text(self.measures.least_margin.as_ref())));
        }
        lines.extend(zmp_error_rms_mm.map(|error| ("ZMP error, RMS, off support changes", format!("{error:.1} mm"))));
        if let Some(cost) = self.measures.cost_of_transport {
            lines.extend(cost.electrical.map(|cost| ("cost of transport, electrical", format!("{cost:.2}"))));
            lines.push(("cost of transport, mechanical", format!("{:.2}", cost.mechanical)));
        }
        if let Some(energy) = self.measures.energy {
            lines.extend(energy.electrical_j.map(|energy| ("electrical energy", format!("{energy:.0} J"))));
            lines.push(("positive work of the joints", format!("{:.0} J", energy.mechanical_j)));
        }
        let loads = &self.measures.joint_loads;
        lines.extend(most_loaded(loads).map(|load| ("greatest share of a drive's torque", load_text(load))));
        let voltage = loads.iter().filter_map(|load| Some((load, load.voltage_share?)));
        if let Some((load, share)) = voltage.max_by(|(_, one), (_, other)| one.total_cmp(other)) {
            let text = format!("{:.0} % at {}", share * 100.0, load.joint.name());
            lines.push(("greatest share of the voltage", text));
        }
        let current = loads.iter().filter_map(|load| Some((load, load.peak_current_a?)));
        if let Some((load, current)) = current.max_by(|(_, one), (_, other)| one.total_cmp(other)) {
            lines.push(("greatest current", format!("{current:.1} A at {}", load.joint.name())));
        }
        lines
    }
}

/// The joint whose drive yields the greatest share of its torque.
pub fn most_loaded(loads: &[JointLoad]) -> Option<&JointLoad> {
    loads.iter().max_by(|one, other| one.torque_share.total_cmp(&other.torque_share))
}

/// The load of a joint in words: `112 N·m at right_knee, 30 % of its limit at standstill`.
pub fn load_text(load: &JointLoad) -> String {
    let share = load.torque_share * 100.0;
    format!("{:.0} N·m at {}, {share:.0} % of its limit at standstill", load.peak_torque_n_m, load.joint.name())
}

/// The least margin and its place in the walk in words.
pub fn margin_text(least: Option<&LeastMargin>) -> String {
    least.map_or("unknown".to_owned(), |LeastMargin { margin_mm, half_step, progress, .. }| {
        let (margin, done) = (margin_mm.round() + 0.0, progress * 100.0);
        format!("{margin:.0} mm (half-step {half_step}, {done:.0} % done)")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn a_summary_tells_the_outcome_and_the_place_of_the_least_margin() {
        let (mut log, mechanism) = (synthetic::log(5, 0.0), synthetic::mechanism());
        log.controller[20].margin = Some(-0.0002);
        let summary = RunSummary::of(&log, &mechanism);
        assert_eq!(summary.outcome(), "walking at the end");
        let lines = summary.lines();
        let value = |name: &str| lines.iter().find(|line| line.0.starts_with(name)).map(|line| line.1.as_str());
        // Tick 20 is the third of the six of half-step 3.
        assert_eq!(value("least margin"), Some("0 mm (half-step 3, 33 % done)"));
        assert_eq!((value("distance"), value("cost")), (Some("1.12 m"), None));
        assert_eq!(margin_text(None), "unknown");
    }

    #[test]
    fn a_run_that_fell_or_stood_faulted_says_so() {
        let (mut log, mechanism) = (synthetic::log(5, 0.0), synthetic::mechanism());
        log.plant[25..].iter_mut().for_each(|row| row.fallen = true);
        assert_eq!(RunSummary::of(&log, &mechanism).outcome(), "fell at 2.50 s in half-step 4, walking at the end");
        let mut log = synthetic::log(5, 0.0);
        log.controller[20..].iter_mut().for_each(|row| (row.mode, row.faults) = ("faulted", 4 | 512));
        log.totals = Default::default();
        log.controller.iter().for_each(|row| log.totals.note_controller(row));
        assert_eq!(
            RunSummary::of(&log, &mechanism).outcome(),
            "stopped at 2.00 s by a fault: no valid measurement has arrived for too long"
        );
    }
}
