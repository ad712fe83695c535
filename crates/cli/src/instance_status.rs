//! What can be seen of an instance from outside.

use std::fmt;
use std::time::Duration;

use interface::{Mode, Report};
use serde::Serialize;
use wire::Participants;

use crate::state_line::{goal_text, hundredths, pose_text, velocity_text};

/// An instance: its processes, and what its controller reports.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct InstanceStatus {
    /// Its name.
    pub(crate) instance: String,
    /// Ids of its processes.
    pub(crate) controller: Option<u32>,
    pub(crate) plant: Option<u32>,
    pub(crate) operators: Vec<u32>,
    pub(crate) observers: Vec<u32>,
    /// The robot and the clock; absent without a controller.
    #[serde(flatten)]
    pub(crate) kind: Option<InstanceKind>,
    /// What the controller reports; absent if it reports nothing.
    #[serde(flatten)]
    pub(crate) state: Option<ReportedState>,
    /// Why something is absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) note: Option<String>,
}

/// What an instance is, whatever it does.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct InstanceKind {
    /// The robot's name, if it is in the box or in `config/`.
    pub(crate) robot: Option<String>,
    /// Its fingerprint.
    pub(crate) mechanism: String,
    /// `realtime` or `lockstep`.
    pub(crate) clock: &'static str,
    /// Control periods per second of the controller's time.
    pub(crate) rate_hz: u32,
}

/// The state of a controller by its reports.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct ReportedState {
    pub(crate) mode: &'static str,
    /// The controller's time since it started (s).
    pub(crate) time_s: f64,
    /// How long ago the newest report was made (s).
    pub(crate) report_age_s: f64,
    /// Control periods per second of the wall clock.
    pub(crate) measured_rate_hz: Option<f64>,
    pub(crate) half_step: u64,
    pub(crate) x_m: f64,
    pub(crate) y_m: f64,
    pub(crate) heading_deg: f64,
    pub(crate) vx: f64,
    pub(crate) vy: f64,
    pub(crate) wz_deg_s: f64,
    pub(crate) margin_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) goal: Option<String>,
    /// What is wrong now.
    pub(crate) faults: Vec<&'static str>,
    pub(crate) missed: u64,
    #[serde(skip)]
    pub(crate) words: StateWords,
}

/// Parts of the state that people read otherwise than programs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StateWords {
    pose: String,
    velocity: String,
    remedy: Option<&'static str>,
}

impl ReportedState {
    /// The state of a report.
    ///
    /// * `time` – the controller's time (s)
    /// * `age` – of the report
    /// * `margin` – the least one seen (m)
    pub(crate) fn new(report: &Report, time: f64, age: Duration, margin: Option<f64>, missed: u64) -> Self {
        let (pose, velocity) = (report.odometry.pose, report.odometry.velocity);
        let words =
            StateWords { pose: pose_text(&pose), velocity: velocity_text(&velocity), remedy: remedy(report.mode) };
        Self {
            mode: report.mode.text(),
            time_s: (time * 1e3).round() / 1e3,
            report_age_s: (age.as_secs_f64() * 1e3).round() / 1e3,
            measured_rate_hz: None,
            half_step: report.half_step.index,
            x_m: thousandths(pose.x),
            y_m: thousandths(pose.y),
            heading_deg: hundredths(pose.heading.to_degrees()),
            vx: thousandths(velocity.ahead),
            vy: thousandths(velocity.left),
            wz_deg_s: hundredths(velocity.turn.to_degrees()),
            margin_mm: margin.map(|margin| hundredths(margin * 1e3)),
            goal: report.destination.as_ref().map(goal_text),
            faults: report.faults.iter().map(|fault| fault.text()).collect(),
            missed,
            words,
        }
    }
}

fn thousandths(value: f64) -> f64 {
    (value * 1e3).round() / 1e3 + 0.0
}

/// What brings a robot back that does not walk any more.
fn remedy(mode: Mode) -> Option<&'static str> {
    match mode {
        Mode::Fallen => Some(
            "put it on its feet (a plant with --lift-when-fallen does so; start another one anew), then send reset",
        ),
        Mode::Faulted => Some("send reset; a refused request names the fault"),
        _ => None,
    }
}

impl InstanceStatus {
    /// An instance of which only the processes are known.
    pub(crate) fn new(instance: String, participants: Participants) -> Self {
        let Participants { controller, plant, operators, observers } = participants;
        Self { instance, controller, plant, operators, observers, kind: None, state: None, note: None }
    }
}

impl fmt::Display for InstanceStatus {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let mode = self.state.as_ref().map_or("no report", |state| state.mode);
        write!(out, "{}: {mode}", self.instance)?;
        if let Some(ReportedState { time_s, report_age_s, .. }) = self.state {
            write!(out, " at {time_s:.2} s")?;
            if report_age_s >= 1.0 {
                write!(out, ", silent for {report_age_s:.0} s")?;
            }
        }
        if let Some(note) = &self.note {
            write!(out, "\n  {note}")?;
        }
        if let Some(remedy) = self.state.as_ref().and_then(|state| state.words.remedy) {
            write!(out, "\n  remedy     {remedy}")?;
        }
        let one = |id: Option<u32>| id.map_or("–".to_owned(), |id| id.to_string());
        write!(out, "\n  processes  controller {}, plant {}", one(self.controller), one(self.plant))?;
        for (name, ids) in [("operators", &self.operators), ("observers", &self.observers)] {
            if !ids.is_empty() {
                let ids: Vec<String> = ids.iter().map(u32::to_string).collect();
                write!(out, ", {name} {}", ids.join(" "))?;
            }
        }
        if let Some(InstanceKind { robot, mechanism, clock, rate_hz }) = &self.kind {
            write!(out, "\n  robot      {}", robot.as_ref().unwrap_or(mechanism))?;
            write!(out, "\n  clock      {clock}, {rate_hz} Hz")?;
        }
        let Some(state) = &self.state else { return Ok(()) };
        if let (Some(measured), Some(kind)) = (state.measured_rate_hz, &self.kind) {
            write!(out, ", {:.1} times as fast as the wall clock", measured / f64::from(kind.rate_hz))?;
        }
        write!(out, ", {} missed", state.missed)?;
        let StateWords { pose, velocity, .. } = &state.words;
        write!(out, "\n  pose       {pose}\n  velocity   {velocity}")?;
        let margin = state.margin_mm.map_or("–".to_owned(), |margin| format!("{margin:.0} mm"));
        write!(out, "\n  walk       half-step {}, ZMP margin {margin}", state.half_step)?;
        if let Some(goal) = &state.goal {
            write!(out, ", {goal}")?;
        }
        for fault in &state.faults {
            write!(out, "\n  fault      {fault}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use interface::{DestinationProgress, Fault};

    use super::*;

    fn status() -> InstanceStatus {
        let participants = Participants {
            controller: Some(1_234_567),
            plant: Some(1_234_568),
            operators: vec![1],
            observers: vec![2, 3],
        };
        InstanceStatus::new("walk-1234567".to_owned(), participants)
    }

    #[test]
    fn a_walk_is_told_in_lines_of_at_most_eighty_columns() {
        let destination = Some(DestinationProgress { places_left: 3, distance: 1.23, turn: 0.0 });
        let faults = [Fault::MeasurementStale, Fault::UnexpectedPosture].into_iter().collect();
        let report = Report { destination, faults, ..Report::of(Mode::Faulted) };
        let state = ReportedState::new(&report, 12.345, Duration::from_millis(1700), Some(0.0361), 3);
        let kind = InstanceKind {
            robot: Some("paper: Vukobratović, Andrić, Borovac".to_owned()),
            mechanism: "0x0123456789abcdef".to_owned(),
            clock: "realtime",
            rate_hz: 1000,
        };
        let state = ReportedState { measured_rate_hz: Some(998.0), ..state };
        let text = InstanceStatus { kind: Some(kind), state: Some(state), ..status() }.to_string();
        assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
        expect![[r#"
            walk-1234567: faulted at 12.35 s, silent for 2 s
              remedy     send reset; a refused request names the fault
              processes  controller 1234567, plant 1234568, operators 1, observers 2 3
              robot      paper: Vukobratović, Andrić, Borovac
              clock      realtime, 1000 Hz, 1.0 times as fast as the wall clock, 3 missed
              pose       x 0.00 m, y 0.00 m, heading 0.0°
              velocity   ahead 0.00 m/s, left 0.00 m/s, turn 0.0 °/s
              walk       half-step 0, ZMP margin 36 mm, goal in 1.2 m, 3 places left
              fault      no valid measurement has arrived for too long
              fault      the robot is not in the posture in which the controller begins"#]]
        .assert_eq(&text);
    }

    #[test]
    fn an_instance_that_only_waits_says_for_whom() {
        let waiting = InstanceStatus { plant: None, note: Some("waits for its plant".to_owned()), ..status() };
        expect![[r#"
            walk-1234567: no report
              waits for its plant
              processes  controller 1234567, plant –, operators 1, observers 2 3"#]]
        .assert_eq(&waiting.to_string());
    }
}
