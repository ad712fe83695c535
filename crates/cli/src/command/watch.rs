//! `halfstep watch`: follows a robot by its controller's reports, until that leaves.

use std::time::Duration;

use interface::Mode;
use interface::Rate;
use node::interrupt::Interrupt;
use wire::{Instance, ObserverPorts};

use super::connect::patiently;
use super::options::{InstanceOption, duration};
use crate::error::CliError;
use crate::observed_changes::{ObservedChanges, WatchedChange};
use crate::output::{print_json, print_line};
use crate::progress::Progress;
use crate::status::Status;

/// Follow a running robot: a line for each change of mode, each fault, and the end of a walk to a goal
///
/// On a terminal the present state is in a line that is refreshed. It only looks on, and ends with the controller: with
/// exit code 1 if the robot lay or stood with a latched fault then. --json prints a JSON value for each line.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct WatchArgs {
    #[command(flatten)]
    instance: InstanceOption,
    /// Also a line whenever this time of the controller has passed, e.g. 1s
    #[arg(long, value_name = "DURATION", value_parser = duration, allow_hyphen_values = true)]
    every: Option<Duration>,
}

const POLL_INTERVAL: Duration = Duration::from_millis(5);
/// Polls without a report until it is checked that the controller is still there.
const SILENT_POLLS: u32 = 40;

impl WatchArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let interrupt = Interrupt::listen()?;
        let instance = self.instance.instance()?;
        let observer = patiently(&instance, || ObserverPorts::connect(&instance))?;
        let rate = Rate::clamped(observer.reports.rate_hz());
        let every = self.every.map(|every| rate.ticks(every).max(1));
        let changes = ObservedChanges::new(rate, every);
        follow(&instance, observer, changes, &Progress::new(None, rate), &interrupt, json)
    }
}

/// Prints what changes until the controller leaves, or this process is asked to end.
fn follow(
    instance: &Instance,
    mut observer: ObserverPorts,
    mut changes: ObservedChanges,
    progress: &Progress,
    interrupt: &Interrupt,
    json: bool,
) -> Result<Status, CliError> {
    let mut silent_polls = 0_u32;
    while !interrupt.is_raised() {
        let mut newest = None;
        while let Some(message) = observer.reports.next_report()? {
            let report = message.checked().map_err(CliError::new)?;
            for change in changes.after(message.tick, &report) {
                print_change(&change, progress, json)?;
            }
            newest = Some((message.tick, report));
        }
        if let Some((tick, report)) = newest {
            silent_polls = 0;
            progress.show(tick, &report);
        } else {
            silent_polls += 1;
            if silent_polls.is_multiple_of(SILENT_POLLS) && !instance.has_controller() {
                print_change(&changes.end(), progress, json)?;
                return Ok(Status::success_if(!matches!(changes.mode(), Some(Mode::Fallen | Mode::Faulted))));
            }
        }
        std::thread::sleep(POLL_INTERVAL);
    }
    Ok(Status::Success)
}

fn print_change(change: &WatchedChange, progress: &Progress, json: bool) -> Result<(), CliError> {
    progress.suspend(|| if json { print_json(change) } else { print_line(change) })
}
