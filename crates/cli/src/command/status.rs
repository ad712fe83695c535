//! `halfstep status`: the robots that are running, as they are seen from outside.

use std::path::Path;
use std::time::Duration;

use config::Config;
use interface::Rate;
use model::Mechanism;
use node::configuration::MECHANISM;
use robots::ROBOTS;
use runtime::now_ns;
use wire::{ConnectError, Instance, ReportMessage, SpectatorPorts, instances_in_use};

use crate::error::CliError;
use crate::instance_status::{InstanceKind, InstanceStatus, ReportedState};
use crate::output::{print_json, print_line};
use crate::status::Status;

/// List the robots that are running: processes, robot, rate, mode, pose, faults
///
/// It looks on for a fifth of a second each, and sends nothing. Exit code 0 also if none is running.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct StatusArgs;

/// How long the reports of an instance are listened to.
const LISTENING: Duration = Duration::from_millis(200);
const POLL_INTERVAL: Duration = Duration::from_millis(5);
/// Least time between two reports that tell the rate (ns).
const APART_NS: u64 = 50_000_000;

/// What was heard of a controller.
#[derive(Default)]
struct Heard {
    first: Option<ReportMessage>,
    last: Option<ReportMessage>,
    /// Least margin (m).
    margin: Option<f64>,
}

impl StatusArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let robots = known_robots();
        let mut found = Vec::new();
        for name in instances_in_use() {
            found.push(look_at(&Instance::new(name.as_str())?, &robots));
        }
        if json {
            print_json(&found)?;
        } else if found.is_empty() {
            print_line("no robot of yours is running; `halfstep walk` starts one")?;
        } else {
            let texts: Vec<String> = found.iter().map(InstanceStatus::to_string).collect();
            print_line(texts.join("\n\n"))?;
        }
        Ok(Status::Success)
    }
}

/// The robots of which the name is known, by their fingerprints: those in the box, and that of `config/`.
fn known_robots() -> Vec<(u64, String)> {
    let named = |robot: Mechanism| (robot.fingerprint, robot.name);
    let own = Mechanism::load(Path::new("config").join(MECHANISM)).ok().map(named);
    let in_box = ROBOTS.iter().filter_map(|robot| {
        let mechanism = Mechanism::from_toml(robot.mechanism_text(), robot.name).ok()?;
        Some((mechanism.fingerprint, format!("{}: {}", robot.name, mechanism.name)))
    });
    in_box.chain(own).collect()
}

/// Looks at an instance. What cannot be seen is noted.
fn look_at(instance: &Instance, robots: &[(u64, String)]) -> InstanceStatus {
    let participants = instance.participants();
    let (has_controller, has_plant) = (participants.controller.is_some(), participants.plant.is_some());
    let status = InstanceStatus::new(instance.name().to_string(), participants);
    if !has_controller {
        return InstanceStatus { note: Some("waits for its controller".to_owned()), ..status };
    }
    let mut ports = match SpectatorPorts::connect(instance) {
        Ok(ports) => ports,
        // It has left meanwhile.
        Err(ConnectError::NoController { .. }) => {
            return InstanceStatus { controller: None, note: Some("waits for its controller".to_owned()), ..status };
        }
        Err(error) => return InstanceStatus { note: Some(error.to_string()), ..status },
    };
    let rate_hz = ports.reports.rate_hz();
    let kind = InstanceKind {
        robot: robots.iter().find(|(fingerprint, _)| *fingerprint == ports.mechanism).map(|(_, name)| name.clone()),
        mechanism: format!("{:#018x}", ports.mechanism),
        clock: if ports.is_lockstep { "lockstep" } else { "realtime" },
        rate_hz,
    };
    let state = Heard::listen(&mut ports).state(Rate::clamped(rate_hz));
    let note = match (&state, has_plant) {
        (Some(_), _) => None,
        (None, false) => Some("waits for its plant".to_owned()),
        (None, true) => Some("controller and plant are there, but nothing is reported".to_owned()),
    };
    InstanceStatus { kind: Some(kind), state, note, ..status }
}

impl Heard {
    fn listen(ports: &mut SpectatorPorts) -> Self {
        let mut heard = Self::default();
        let until_ns = now_ns() + LISTENING.as_nanos() as u64;
        while now_ns() < until_ns {
            // A report that cannot be received is a lost one.
            while let Ok(Some(report)) = ports.reports.next_report() {
                heard.first.get_or_insert(report);
                heard.last = Some(report);
                let margin = Some(report.margin).filter(|margin| !margin.is_nan());
                heard.margin =
                    heard.margin.map_or(margin, |least| margin.map(|margin| margin.min(least)).or(Some(least)));
            }
            std::thread::sleep(POLL_INTERVAL);
        }
        heard
    }

    fn state(&self, rate: Rate) -> Option<ReportedState> {
        let last = self.last?;
        let age = Duration::from_nanos(now_ns().saturating_sub(last.time_ns));
        let report = last.checked().ok()?;
        let state = ReportedState::new(&report, rate.time(last.tick), age, self.margin, last.timing().missed);
        Some(ReportedState { measured_rate_hz: self.measured_rate_hz(), ..state })
    }

    /// Control periods per second of the wall clock.
    fn measured_rate_hz(&self) -> Option<f64> {
        let (first, last) = (self.first?, self.last?);
        let passed_ns = last.time_ns.checked_sub(first.time_ns).filter(|passed| *passed >= APART_NS)?;
        let ticks = last.tick.checked_sub(first.tick)?;
        Some((ticks as f64 * 1e10 / passed_ns as f64).round() / 10.0)
    }
}
