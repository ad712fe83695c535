//! Options that several commands have in common.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use interface::{COMMAND_TIMEOUT_MAX, Rate};
use node::announcements::Announced;
use node::cycle::Clock;
use wire::{Instance, InstanceName};

use crate::error::CliError;
use crate::process::{end_cleanly_with_parent, end_with_parent};

/// Which robot to talk to.
#[derive(Clone, Debug, Args)]
pub(super) struct InstanceOption {
    /// Instance name of the robot: 1 to 32 of a–z, 0–9, _ and -
    #[arg(long, global = true, value_name = "NAME", default_value = "default")]
    pub instance: InstanceName,
}

impl InstanceOption {
    pub(super) fn instance(&self) -> Result<Instance, CliError> {
        Ok(Instance::new(self.instance.as_str())?)
    }

    /// The instance as controller and plant see it, with what both must agree on.
    pub(super) fn of_loop(&self, rate: Rate, runs: &LoopOptions) -> Result<Instance, CliError> {
        let instance = self.instance()?.with_rate_hz(rate.hz());
        Ok(instance.with_lockstep(runs.lockstep).with_stand(runs.from_stand))
    }
}

/// Duration and clock of a loop.
#[derive(Clone, Debug, Args)]
pub(super) struct LoopOptions {
    /// End after this time, e.g. 20s or 2min [default: run until Ctrl-C]
    #[arg(long = "for", value_name = "DURATION", value_parser = duration, allow_hyphen_values = true)]
    pub duration: Option<Duration>,
    /// Run in lockstep with the other process, deterministic and as fast as possible, instead of in real time
    #[arg(long)]
    pub lockstep: bool,
    /// Start from a stand, feet side by side, instead of in stride
    #[arg(long)]
    pub from_stand: bool,
}

impl LoopOptions {
    pub(super) fn ticks(&self, rate: Rate) -> Option<u64> {
        self.duration.map(|duration| rate.ticks(duration).max(1))
    }

    pub(super) fn clock(&self) -> Clock {
        if self.lockstep { Clock::Lockstep } else { Clock::Realtime }
    }

    /// How the process was started, as entries for its recording.
    pub(super) fn words(&self, instance: &InstanceOption, rate: Rate, fingerprint: u64) -> [(&'static str, String); 7] {
        [
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("protocol", wire::PROTOCOL.to_string()),
            ("mechanism", format!("{fingerprint:#018x}")),
            ("instance", instance.instance.to_string()),
            ("clock", self.clock().text().to_owned()),
            ("rate_hz", rate.hz().to_string()),
            ("from_stand", self.from_stand.to_string()),
        ]
    }
}

/// Options of processes that `walk` starts.
#[derive(Clone, Debug, Args)]
pub(super) struct ChildOptions {
    /// Record the run into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Parent process: this one ends when it does
    #[arg(long, value_name = "PID", hide = true)]
    pub parent: Option<u32>,
}

impl ChildOptions {
    /// What the process tells while it runs: `walk` shows the modes itself.
    pub(super) fn announced(&self) -> Announced {
        if self.parent.is_some() { Announced::Faults } else { Announced::All }
    }

    /// Ends this process with its parent, if it has one to end with.
    pub(super) fn bind(&self) -> Result<(), CliError> {
        self.parent.map_or(Ok(()), end_with_parent)
    }

    /// The same, in a clean way: the run begins.
    pub(super) fn bind_run(&self) -> Result<(), CliError> {
        self.parent.map_or(Ok(()), |_| end_cleanly_with_parent())
    }
}

/// Shortest duration that is accepted: a shorter one is a mistake.
const DURATION_MIN: Duration = Duration::from_millis(1);

/// How long a source may be silent, or hold control authority: at most as long as the controller lets it.
pub(super) fn command_timeout(text: &str) -> Result<Duration, String> {
    let timeout = duration(text)?;
    if timeout > Duration::from_secs_f64(COMMAND_TIMEOUT_MAX) {
        return Err(format!("must be at most {COMMAND_TIMEOUT_MAX}s"));
    }
    Ok(timeout)
}

pub(super) fn duration(text: &str) -> Result<Duration, String> {
    if text.starts_with('-') {
        return Err("must not be negative; write e.g. 20s or 2min".to_owned());
    }
    let duration = humantime::parse_duration(text).map_err(|error| format!("{error}; write e.g. 20s or 2min"))?;
    if duration < DURATION_MIN { Err("must be at least 1ms".to_owned()) } else { Ok(duration) }
}

/// A time of a run in seconds: `3.5`, or with a unit as in `3500ms`.
pub(super) fn run_time(text: &str) -> Result<f64, String> {
    let seconds = match text.parse::<f64>() {
        Ok(seconds) => Some(seconds).filter(|seconds| seconds.is_finite() && *seconds >= 0.0),
        Err(_) => humantime::parse_duration(text).ok().map(|time| time.as_secs_f64()),
    };
    seconds.ok_or_else(|| "must be a time since the start of the run, e.g. 3.5s or 2min".to_owned())
}

/// A number as people write it.
pub(super) fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "must be a number, e.g. 10 or -2.5".to_owned())
}

/// An option of a path as one word for another process: a path may begin with a hyphen.
pub(super) fn path_option(option: &str, path: &Path) -> OsString {
    let mut word = OsString::from(option);
    word.push("=");
    word.push(path);
    word
}
