//! The commands, one per file.

mod bench;
mod check;
mod controller;
mod export;
mod import;
mod paper;
mod plant;
mod plot;
mod replay;
mod send;
mod stream;
mod synthesize;
mod walk;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args, Parser, Subcommand};
use runtime::Rate;
use serde::Serialize;
use wire::{Instance, InstanceName};

use crate::failure::{Failure, Outcome};
use crate::process::end_with_parent;
use crate::turns::Clock;

/// Walk a 20-joint biped from one nominal half-step, and bend it while it walks.
#[derive(Debug, Parser)]
#[command(version, about)]
pub struct Halfstep {
    #[command(subcommand)]
    command: Command,
    /// Print what a program can read on stdout, as JSON
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    Walk(walk::Walk),
    Controller(controller::Controller),
    Plant(plant::Plant),
    Send(send::Send),
    Stream(stream::Stream),
    Synthesize(synthesize::Synthesize),
    Paper(paper::Paper),
    Check(check::Check),
    Bench(bench::Bench),
    Export(export::Export),
    Import(import::Import),
    Plot(plot::Plot),
    Replay(replay::Replay),
}

impl Halfstep {
    /// Does it.
    ///
    /// # Errors
    /// Why it could not be done.
    pub fn run(self) -> Result<Outcome, Failure> {
        let json = self.json;
        match self.command {
            Command::Walk(walk) => walk.run(json),
            Command::Controller(controller) => controller.run(json),
            Command::Plant(plant) => plant.run(json),
            Command::Send(send) => send.run(json),
            Command::Stream(stream) => stream.run(json),
            Command::Synthesize(synthesize) => synthesize.run(json),
            Command::Paper(paper) => paper.run(json),
            Command::Check(check) => check.run(json),
            Command::Bench(bench) => bench.run(json),
            Command::Export(export) => export.run(),
            Command::Import(import) => import.run(json),
            Command::Plot(plot) => plot.run(json),
            Command::Replay(replay) => replay.run(json),
        }
    }
}

/// Which robot to talk to.
#[derive(Clone, Debug, Args)]
struct InstanceOption {
    /// Which robot, if there are several: 1 to 32 of a–z, 0–9, _ and -
    #[arg(long, global = true, value_name = "NAME", default_value = "default")]
    instance: InstanceName,
}

impl InstanceOption {
    fn instance(&self) -> Result<Instance, Failure> {
        Ok(Instance::new(self.instance.as_str())?)
    }

    fn at_rate(&self, rate: Rate) -> Result<Instance, Failure> {
        Ok(self.instance()?.with_rate_hz(rate.hz()))
    }
}

/// How long a loop runs, and by what clock.
#[derive(Clone, Debug, Args)]
struct LoopOptions {
    /// End after this time, e.g. 20s or 2min; without it, at Ctrl-C
    #[arg(long = "for", value_name = "DURATION", value_parser = duration)]
    duration: Option<Duration>,
    /// Tick for tick with the other side, deterministic and as fast as it goes, instead of in real time
    #[arg(long)]
    lockstep: bool,
    /// Begin at a stand, with the feet side by side, instead of in stride
    #[arg(long)]
    from_stand: bool,
}

impl LoopOptions {
    fn ticks(&self, rate: Rate) -> Option<u64> {
        self.duration.map(|duration| rate.ticks(duration).max(1))
    }

    fn clock(&self) -> Clock {
        if self.lockstep { Clock::Lockstep } else { Clock::Realtime }
    }

    /// How a process of a pair was started, for its recording.
    fn words(&self, instance: &InstanceOption, rate: Rate, fingerprint: u64) -> [(&'static str, String); 7] {
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

/// What only the processes of a pair need.
#[derive(Clone, Debug, Args)]
struct PartOptions {
    /// Record the run into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The process that started this one, and with which it ends
    #[arg(long, value_name = "PID", hide = true)]
    parent: Option<u32>,
}

impl PartOptions {
    fn bind(&self) -> Result<(), Failure> {
        self.parent.map_or(Ok(()), end_with_parent)
    }
}

/// The control period, if nobody chose another.
const DURATION_MIN: Duration = Duration::from_millis(1);

fn duration(text: &str) -> Result<Duration, String> {
    let duration = humantime::parse_duration(text).map_err(|error| format!("{error}; write e.g. 20s or 2min"))?;
    if duration < DURATION_MIN { Err("must be at least 1ms, one control period".to_owned()) } else { Ok(duration) }
}

/// Prints a value for a program or for a person.
fn print(json: bool, value: &(impl Serialize + std::fmt::Display)) -> Result<(), Failure> {
    if json { print_json(value) } else { print_line(value) }
}

/// Prints a value as a program reads it.
fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(value).map_err(Failure::new)?;
    print_line(text)
}

/// Prints a line at once. That nobody reads it any more is no reason to go on.
fn print_line(text: impl std::fmt::Display) -> Result<(), Failure> {
    use std::io::Write;
    let mut stdout = std::io::stdout().lock();
    writeln!(stdout, "{text}")
        .and_then(|()| stdout.flush())
        .map_err(|error| Failure::new(format!("cannot print: {error}")))
}

/// Writes pictures into a folder.
fn write_pictures(folder: &Path, pictures: &[(&str, String)]) -> Result<(), Failure> {
    let cannot = |path: &Path, error| Failure::new(format!("{}: {error}", path.display()));
    fs::create_dir_all(folder).map_err(|error| cannot(folder, error))?;
    for (name, text) in pictures {
        let file = folder.join(name);
        fs::write(&file, text).map_err(|error| cannot(&file, error))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        super::Halfstep::command().debug_assert();
    }
}
