//! Waits until the robot is at its destination, by the controller's reports.

use std::time::Duration;

use dialogue::reply_text::ReplyJson;
use interface::{DestinationProgress, Mode, Report};
use node::interrupt::Interrupt;
use node::tell::tell;
use serde::Serialize;
use wire::{ConnectError, Instance, ObserverPorts, OperatorPorts};

use crate::error::CliError;
use crate::output::{print_json, print_line};
use crate::state_line::goal_text;
use crate::status::Status;

const POLL_INTERVAL: Duration = Duration::from_millis(10);
/// Polls without a report until it is checked that the controller is still there.
const SILENT_POLLS: u32 = 100;
/// Time between two reports that are told (ns).
const TELL_INTERVAL_NS: u64 = 1_000_000_000;

/// The reports of a controller to which a destination is sent.
pub(super) struct Arrival {
    instance: Instance,
    observer: ObserverPorts,
    interrupt: Interrupt,
}

/// How the walk to a destination ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum WalkEnd {
    Arrived,
    /// Another request moves the robot, or stopped it.
    Cancelled,
    Fallen,
    Faulted,
    /// It goes on: this process was asked to end.
    NotAwaited,
}

/// The reply, and how the walk that it granted has ended, as one JSON value.
#[derive(Serialize)]
struct ArrivalJson {
    #[serde(flatten)]
    reply: ReplyJson,
    walk_end: WalkEndJson,
}

/// The end as JSON.
#[derive(Serialize)]
struct WalkEndJson {
    destination: WalkEnd,
    distance_m: f64,
    turn_deg: f64,
}

/// What the reports have told so far.
#[derive(Debug, Default)]
struct Followed {
    /// The newest progress.
    progress: Option<DestinationProgress>,
}

impl Arrival {
    /// Listens to the reports: before the request is sent, so that none is missed.
    pub(super) fn listen(instance: &Instance) -> Result<Self, CliError> {
        let observer = super::connect::patiently(instance, || ObserverPorts::connect(instance))?;
        Ok(Self { instance: instance.clone(), observer, interrupt: Interrupt::listen()? })
    }

    /// Waits for the end of a walk that was granted.
    ///
    /// * `granted_ns` – when the reply had arrived: earlier reports may tell of another destination
    /// * `reply` – printed with the end, as JSON; the end is printed as text without it
    pub(super) fn wait(mut self, granted_ns: u64, reply: Option<ReplyJson>) -> Result<Status, CliError> {
        let mut followed = Followed::default();
        let (mut silent_polls, mut told_ns) = (0_u32, granted_ns);
        while !self.interrupt.is_raised() {
            let Some(message) = self.observer.reports.next_report().map_err(CliError::new)? else {
                silent_polls += 1;
                if silent_polls.is_multiple_of(SILENT_POLLS) {
                    self.require_controller()?;
                }
                std::thread::sleep(POLL_INTERVAL);
                continue;
            };
            silent_polls = 0;
            if message.time_ns < granted_ns {
                continue;
            }
            let report = message.checked().map_err(CliError::new)?;
            if let Some(end) = followed.hear(&report) {
                return followed.conclude(end, reply);
            }
            if let Some(progress) = followed.progress
                && message.time_ns >= told_ns + TELL_INTERVAL_NS
            {
                told_ns = message.time_ns;
                tell(goal_text(&progress));
            }
        }
        followed.conclude(WalkEnd::NotAwaited, reply)
    }

    fn require_controller(&self) -> Result<(), CliError> {
        match OperatorPorts::connect(&self.instance) {
            Err(ConnectError::NoController { .. }) => Err(CliError::new("the controller has left")),
            _ => Ok(()),
        }
    }
}

impl Followed {
    /// Takes in a report, and says whether the walk has ended.
    fn hear(&mut self, report: &Report) -> Option<WalkEnd> {
        match report.mode {
            Mode::Fallen => return Some(WalkEnd::Fallen),
            Mode::Faulted => return Some(WalkEnd::Faulted),
            _ => {}
        }
        let Some(progress) = report.destination else { return Some(WalkEnd::Cancelled) };
        // Places are only passed: more of them are another destination's.
        if self.progress.is_some_and(|before| progress.places_left > before.places_left) {
            return Some(WalkEnd::Cancelled);
        }
        self.progress = Some(progress);
        (progress.places_left == 0).then_some(WalkEnd::Arrived)
    }

    fn conclude(&self, end: WalkEnd, reply: Option<ReplyJson>) -> Result<Status, CliError> {
        let progress = self.progress.unwrap_or_default();
        if let Some(reply) = reply {
            let (distance_m, turn_deg) = (progress.distance, progress.turn.to_degrees());
            let walk_end = WalkEndJson { destination: end, distance_m, turn_deg };
            print_json(&ArrivalJson { reply, walk_end })?;
        } else {
            print_line(self.text(end))?;
        }
        Ok(Status::success_if(end == WalkEnd::Arrived))
    }

    fn text(&self, end: WalkEnd) -> String {
        let left = self.progress.map_or(String::new(), |progress| format!(": {}", goal_text(&progress)));
        match end {
            WalkEnd::Arrived => "arrived".to_owned(),
            WalkEnd::Cancelled => format!("cancelled by another request, or by the end of its stream{left}"),
            WalkEnd::Fallen => format!("the robot has fallen{left}"),
            WalkEnd::Faulted => format!("a fault is latched{left}"),
            WalkEnd::NotAwaited => format!("no longer waited for, the robot walks on{left}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(mode: Mode, destination: Option<(u32, f64)>) -> Report {
        let progress = |(places_left, distance)| DestinationProgress { places_left, distance, turn: 0.0 };
        Report { destination: destination.map(progress), ..Report::of(mode) }
    }

    #[test]
    fn a_walk_has_ended_when_no_place_is_left() {
        let mut followed = Followed::default();
        for left in [(2, 3.0), (2, 2.0), (1, 1.2)] {
            assert_eq!(followed.hear(&report(Mode::Walking, Some(left))), None);
        }
        assert_eq!(followed.hear(&report(Mode::Standing, Some((0, 0.01)))), Some(WalkEnd::Arrived));
    }

    #[test]
    fn a_walk_that_is_cancelled_tells_how_far_it_was() {
        let walking = || {
            let mut followed = Followed::default();
            assert_eq!(followed.hear(&report(Mode::Walking, Some((1, 1.2)))), None);
            followed
        };
        for (mode, destination, end) in [
            (Mode::Stopping, None, WalkEnd::Cancelled),
            (Mode::Walking, Some((3, 5.0)), WalkEnd::Cancelled),
            (Mode::Fallen, Some((1, 1.1)), WalkEnd::Fallen),
            (Mode::Faulted, None, WalkEnd::Faulted),
        ] {
            let mut followed = walking();
            assert_eq!(followed.hear(&report(mode, destination)), Some(end));
            assert!(followed.text(end).ends_with("goal in 1.2 m, 1 place left"), "{}", followed.text(end));
        }
        assert_eq!(Followed::default().hear(&report(Mode::Standing, None)), Some(WalkEnd::Cancelled));
    }
}
