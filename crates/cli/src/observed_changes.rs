//! What changes from report to report, as `watch` tells it.

use std::fmt;

use interface::Rate;
use interface::{DestinationProgress, Fault, Faults, Mode, Report};
use serde::Serialize;

use crate::state_line::{hundredths, state_line};

/// A fault that comes again within this time (s) is the same one.
const SAME_FAULT: f64 = 1.0;
/// Faults that come and go in a walk without any harm, in every few steps.
const PASSING: [Fault; 2] = [Fault::InTheAir, Fault::RateLimited];

/// Something that has changed, with the state of the robot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct WatchedChange {
    /// The controller's time since it started (s).
    time_s: f64,
    event: WatchEvent,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<&'static str>,
    mode: &'static str,
    half_step: u64,
    x_m: f64,
    y_m: f64,
    heading_deg: f64,
    vx: f64,
    /// The least since the line before (m).
    margin_mm: Option<f64>,
    #[serde(skip)]
    line: String,
}

/// What has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum WatchEvent {
    /// The mode, or nothing was known before.
    Mode,
    /// Some time has passed.
    Time,
    Fault,
    /// The last place of a destination is reached.
    Arrived,
    /// A destination was given up.
    Cancelled,
    /// The controller was started anew.
    Restarted,
    /// The controller has left.
    Left,
}

/// Finds what changes.
#[derive(Clone, Debug)]
pub(crate) struct ObservedChanges {
    rate: Rate,
    /// Ticks after which the state is told also if nothing has changed.
    every: Option<u64>,
    last: Option<(u64, Report)>,
    told: u64,
    /// Least margin since the last change that was told (m).
    margin: Option<f64>,
    /// When each fault was last seen (s).
    faults: Vec<(Fault, f64)>,
}

impl ObservedChanges {
    /// Nothing is known yet of a controller with this rate.
    pub(crate) fn new(rate: Rate, every: Option<u64>) -> Self {
        Self { rate, every, last: None, told: 0, margin: None, faults: Vec::new() }
    }

    /// What the robot did last.
    pub(crate) fn mode(&self) -> Option<Mode> {
        self.last.as_ref().map(|(_, report)| report.mode)
    }

    /// What a report changes.
    pub(crate) fn after(&mut self, tick: u64, report: &Report) -> Vec<WatchedChange> {
        let mut events = Vec::new();
        let last = self.last.replace((tick, *report));
        if last.is_some_and(|(before, _)| tick < before) {
            *self = Self { last: self.last, ..Self::new(self.rate, self.every) };
            events.push((WatchEvent::Restarted, None));
        }
        self.margin = match (self.margin, report.margin) {
            (Some(least), Some(margin)) => Some(least.min(margin)),
            (least, margin) => least.or(margin),
        };
        events.extend(self.new_faults(report.faults, self.rate.time(tick)));
        let before = last.and_then(|(_, report)| report.destination);
        events.extend(destination_event(before, report.destination).map(|event| (event, None)));
        if last.is_none_or(|(_, last)| last.mode != report.mode) {
            events.push((WatchEvent::Mode, None));
        } else if self.every.is_some_and(|every| tick >= self.told + every) {
            events.push((WatchEvent::Time, None));
        }
        let changes = events.into_iter().map(|(event, fault)| self.change(tick, report, event, fault)).collect();
        if !Vec::is_empty(&changes) {
            (self.told, self.margin) = (tick, None);
        }
        changes
    }

    /// The controller has left.
    pub(crate) fn end(&self) -> WatchedChange {
        match &self.last {
            Some((tick, report)) => self.change(*tick, report, WatchEvent::Left, None),
            None => WatchedChange { line: "the controller has left".to_owned(), ..WatchedChange::unknown() },
        }
    }

    fn new_faults(&mut self, faults: Faults, time: f64) -> Vec<(WatchEvent, Option<Fault>)> {
        let mut new = Vec::new();
        for fault in faults.iter().filter(|fault| !PASSING.contains(fault)) {
            match self.faults.iter_mut().find(|(known, _)| *known == fault) {
                Some((_, seen)) if time - *seen < SAME_FAULT => *seen = time,
                Some((_, seen)) => {
                    *seen = time;
                    new.push((WatchEvent::Fault, Some(fault)));
                }
                None => {
                    self.faults.push((fault, time));
                    new.push((WatchEvent::Fault, Some(fault)));
                }
            }
        }
        new
    }

    fn change(&self, tick: u64, report: &Report, event: WatchEvent, fault: Option<Fault>) -> WatchedChange {
        let time = self.rate.time(tick);
        let told = match (event, fault) {
            (WatchEvent::Fault, Some(fault)) => format!("fault: {fault}"),
            (WatchEvent::Arrived, _) => "arrived at the goal".to_owned(),
            (WatchEvent::Cancelled, _) => "the goal was given up".to_owned(),
            (WatchEvent::Restarted, _) => "the controller was started anew".to_owned(),
            (WatchEvent::Left, _) => format!("the controller has left: {}", report.mode),
            _ => state_line(report, self.margin),
        };
        let pose = report.odometry.pose;
        WatchedChange {
            time_s: (time * 1e3).round() / 1e3,
            event,
            fault: fault.map(Fault::text),
            mode: report.mode.text(),
            half_step: report.half_step.index,
            x_m: hundredths(pose.x),
            y_m: hundredths(pose.y),
            heading_deg: hundredths(pose.heading.to_degrees()),
            vx: hundredths(report.odometry.velocity.ahead),
            margin_mm: self.margin.map(|margin| hundredths(margin * 1e3)),
            line: format!("{time:8.2} s {told}"),
        }
    }
}

impl WatchedChange {
    /// The end of a controller that has never reported.
    fn unknown() -> Self {
        Self {
            time_s: 0.0,
            event: WatchEvent::Left,
            fault: None,
            mode: "no report",
            half_step: 0,
            x_m: 0.0,
            y_m: 0.0,
            heading_deg: 0.0,
            vx: 0.0,
            margin_mm: None,
            line: String::new(),
        }
    }
}

/// Whether a walk to a destination has ended, and how.
fn destination_event(before: Option<DestinationProgress>, now: Option<DestinationProgress>) -> Option<WatchEvent> {
    let before = before.filter(|before| before.places_left > 0)?;
    match now {
        Some(now) if now.places_left == 0 => Some(WatchEvent::Arrived),
        None => Some(WatchEvent::Cancelled),
        Some(now) => (now.places_left > before.places_left).then_some(WatchEvent::Cancelled),
    }
}

impl fmt::Display for WatchedChange {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(&self.line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn events(changes: &[WatchedChange]) -> Vec<WatchEvent> {
        changes.iter().map(|change| change.event).collect()
    }

    fn watched(every: Option<u64>) -> ObservedChanges {
        ObservedChanges::new(Rate::clamped(1000), every)
    }

    #[test]
    fn each_change_of_mode_is_told_once() {
        let mut changes = watched(None);
        let modes = [Mode::Walking, Mode::Walking, Mode::Stopping, Mode::Standing, Mode::Standing];
        let told: Vec<usize> =
            (0..).zip(modes).map(|(tick, mode)| changes.after(tick, &Report::of(mode)).len()).collect();
        assert_eq!(told, [1, 0, 1, 1, 0]);
        assert_eq!(changes.mode(), Some(Mode::Standing));
        assert_eq!(changes.end().to_string(), "    0.00 s the controller has left: standing");
    }

    #[test]
    fn a_fault_is_told_again_only_after_a_while_and_passing_ones_never() {
        let faulty = |fault| Report { faults: [fault].into_iter().collect(), ..Report::of(Mode::Walking) };
        let (missed, airborne) = (faulty(Fault::DeadlineMissed), faulty(Fault::InTheAir));
        let mut changes = watched(None);
        assert_eq!(events(&changes.after(0, &missed)), [WatchEvent::Fault, WatchEvent::Mode]);
        assert_eq!(events(&changes.after(500, &missed)), []);
        assert_eq!(events(&changes.after(1400, &missed)), []);
        assert_eq!(events(&changes.after(2500, &missed)), [WatchEvent::Fault]);
        assert_eq!(events(&changes.after(9000, &airborne)), []);
    }

    #[test]
    fn the_state_is_told_at_intervals_with_the_least_margin_in_between() {
        let mut changes = watched(Some(1000));
        let mut told = Vec::new();
        for tick in 0..3000_u64 {
            let margin = if tick == 1500 { 0.01 } else { 0.03 };
            told.extend(changes.after(tick, &Report { margin: Some(margin), ..Report::of(Mode::Walking) }));
        }
        let margins: Vec<f64> = told.iter().filter_map(|change| change.margin_mm).collect();
        assert_eq!(
            (events(&told), margins),
            (vec![WatchEvent::Mode, WatchEvent::Time, WatchEvent::Time], vec![30.0, 30.0, 10.0])
        );
    }

    #[test]
    fn the_end_of_a_walk_to_a_goal_is_told() {
        let at = |places: Option<u32>| {
            let destination = places.map(|places_left| DestinationProgress { places_left, distance: 1.0, turn: 0.0 });
            Report { destination, ..Report::of(Mode::Walking) }
        };
        for (then, event) in [
            (at(Some(0)), WatchEvent::Arrived),
            (at(None), WatchEvent::Cancelled),
            (at(Some(3)), WatchEvent::Cancelled),
        ] {
            let mut changes = watched(None);
            changes.after(0, &at(Some(2)));
            assert_eq!(events(&changes.after(1, &at(Some(1)))), []);
            assert_eq!(events(&changes.after(2, &then)), [event]);
        }
    }

    #[test]
    fn a_controller_that_begins_anew_is_told() {
        let mut changes = watched(None);
        changes.after(5000, &Report::of(Mode::Walking));
        assert_eq!(events(&changes.after(0, &Report::of(Mode::Walking))), [WatchEvent::Restarted]);
    }
}
