//! `halfstep bench`: how fast it is on this machine, beside others in the same run.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use ::bench::compute::{ComputeOptions, compute};
use ::bench::exchange::{ExchangeOptions, answer, exchange};
use ::bench::jitter::{JitterOptions, jitter};
use ::bench::{BenchError, Findings};
use clap::Subcommand;
use plant::Plant;
use runtime::Scheduling;
use wire::{Instance, InstanceName};

use super::{duration, print, print_line};
use crate::bench_page::bench_page;
use crate::configuration::{ConfigOptions, Errors, Robot};
use crate::failure::{Failure, Outcome};
use crate::in_command::{self, InCommandOptions};
use crate::realtime::RealtimeParameters;
use crate::watched::{WatchedOptions, watched};

/// Measure speed, latency and jitter beside others in the same run
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "A time says something about the machine; the verdict is a ratio of two numbers of one run. \
Nothing else should run meanwhile.")]
pub struct Bench {
    #[command(flatten)]
    config: ConfigOptions,
    /// Also write bench.html, with histograms, and bench.json into this folder
    #[arg(long, value_name = "DIR", global = true)]
    out: Option<PathBuf>,
    #[command(subcommand)]
    what: What,
}

#[derive(Clone, Debug, Subcommand)]
enum What {
    /// A configuration, a step of the plant, a tick, a plan
    Compute {
        /// How often everything takes turns
        #[arg(long, value_name = "N", default_value_t = 5)]
        rounds: u32,
        /// How long a turn lasts
        #[arg(long, value_name = "DURATION", value_parser = duration, default_value = "300ms")]
        turn: Duration,
    },
    /// The exchange between two processes beside iceoryx2 and shared memory; the controller from outside
    Latency {
        /// How often all ways of exchange take turns
        #[arg(long, value_name = "N", default_value_t = 8)]
        rounds: u32,
        /// Round trips of a round, flat out
        #[arg(long, value_name = "N", default_value_t = 20_000)]
        trips: u64,
        /// Requests to the controller, each 1.35 s after the other
        #[arg(long, value_name = "N", default_value_t = 20)]
        requests: u32,
    },
    /// How late the loop wakes up, beside cyclictest or a bare loop; the controller, watched and left alone
    Jitter {
        /// How often all loops take turns
        #[arg(long, value_name = "N", default_value_t = 12)]
        segments: u32,
        /// How long a turn lasts; 5s for a number to quote
        #[arg(long, value_name = "DURATION", value_parser = duration, default_value = "1s")]
        segment: Duration,
    },
    /// The process that answers `latency`
    #[command(hide = true)]
    Answer {
        #[arg(long)]
        instance: InstanceName,
        #[arg(long)]
        core: usize,
        #[arg(long)]
        priority: Option<u8>,
    },
}

/// How long before its deadline the spinning loop of `jitter` stops sleeping, unless realtime.toml says.
const SPIN: Duration = Duration::from_micros(150);
/// As a process has it at its beginning: controllers are large values, and several are made ready at once [bytes].
const STACK: usize = 8 << 20;
/// Round trips of a round at the loop's pace.
const TRIPS_AT_PACE: u64 = 500;
/// Periods of the controller flat out.
const FLAT_OUT: u64 = 20_000;

impl Bench {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let findings = match &self.what {
            What::Answer { instance, core, priority } => {
                let scheduling = Scheduling { priority: *priority, ..awake_on(*core) };
                answer(&Instance::new(instance.as_str())?, &scheduling)?;
                return Ok(Outcome::Fine);
            }
            What::Compute { rounds, turn } => self.compute(*rounds, *turn)?,
            What::Latency { rounds, trips, requests } => self.latency(*rounds, *trips, *requests)?,
            What::Jitter { segments, segment } => self.jitter(*segments, *segment)?,
        };
        print(json, &findings)?;
        if let Some(folder) = &self.out {
            let told = serde_json::to_string_pretty(&findings).map_err(Failure::new)? + "\n";
            super::write_pictures(folder, &[("bench.html", bench_page(&findings)), ("bench.json", told)])?;
            if !json {
                print_line(format_args!("bench.html and bench.json are in {}", folder.display()))?;
            }
        }
        // Whether a ratio is reached is told; a machine that is busy is no failure.
        Ok(Outcome::Fine)
    }

    fn compute(&self, rounds: u32, turn: Duration) -> Result<Findings, Failure> {
        let Loaded { robot, controller, plant, realtime } = self.load()?;
        let Scheduling { core, lock_memory, .. } = realtime.controller;
        let options = ComputeOptions {
            mechanism: robot.mechanism,
            nominal: robot.nominal,
            controller,
            plant,
            rounds,
            turn,
            period: realtime.rate.period_s(),
            scheduling: Scheduling { core, lock_memory, ..Scheduling::default() },
        };
        Ok(apart(|| compute(&options))??)
    }

    fn latency(&self, rounds: u32, trips: u64, requests: u32) -> Result<Findings, Failure> {
        let Loaded { robot, plant: parameters, realtime, .. } = self.load()?;
        let cores = cores(&realtime)?;
        let period = realtime.rate.period();
        let priority = realtime.controller.priority;
        let scheduling = cores.map(|core| Scheduling { priority, ..awake_on(core) });
        let options = ExchangeOptions { rounds, trips, trips_at_pace: TRIPS_AT_PACE, period, scheduling };
        let instance = own_instance("exchange")?;
        let answering = || {
            let mut command = Command::new(std::env::current_exe()?);
            let core = cores[1].to_string();
            command.args(["bench", "answer", "--instance", instance.name().as_str(), "--core", &core]);
            command.args(priority.into_iter().flat_map(|priority| ["--priority".to_owned(), priority.to_string()]));
            Ok(command)
        };
        let mut findings = apart(|| exchange(&options, &instance, answering))??;

        let options = InCommandOptions { rate: realtime.rate, requests, flat_out: FLAT_OUT, scheduling: scheduling[0] };
        let start = robot.nominal.at(0.0);
        let new_plant = || Plant::new(&robot.mechanism, &parameters, &start, realtime.rate.period_s(), 1);
        let at_pace = self.with_controller(&realtime, &[], |instance| {
            in_command::at_pace(&options, instance, &robot.mechanism, &mut new_plant())
        })?;
        let flat_out = self.with_controller(&realtime, &["--lockstep"], |instance| {
            in_command::flat_out(&options, instance, &robot.mechanism, &mut new_plant())
        })?;
        findings.series.extend(at_pace.series.into_iter().chain([flat_out]));
        findings.ratios.extend(at_pace.ratios);
        findings.notes.extend(at_pace.notes);
        Ok(findings)
    }

    fn jitter(&self, segments: u32, segment: Duration) -> Result<Findings, Failure> {
        let Loaded { robot, plant: parameters, realtime, .. } = self.load()?;
        let [busy, core] = cores(&realtime)?;
        let spin = if realtime.spin.is_zero() { SPIN } else { realtime.spin };
        let mut findings = jitter(&JitterOptions {
            segments,
            segment,
            period: realtime.rate.period(),
            spin,
            scheduling: Scheduling { core: Some(core), ..realtime.controller },
            busy_core: (busy != core).then_some(busy),
        })?;

        let options = WatchedOptions { rate: realtime.rate, loop_core: realtime.controller.core, segments, segment };
        let instance = own_instance("watched")?.with_rate_hz(realtime.rate.hz());
        let controller = |folder: Option<&Path>| {
            let mut command = self.controller(&instance)?;
            command.args(folder.into_iter().flat_map(|folder| [OsStr::new("--out"), folder.as_os_str()]));
            Ok(command)
        };
        let start = robot.nominal.at(0.0);
        let new_plant = || Plant::new(&robot.mechanism, &parameters, &start, realtime.rate.period_s(), 1);
        let (series, ratios) = apart(|| watched(&options, &instance, controller, &robot.mechanism, new_plant))??;
        findings.series.extend(series);
        findings.ratios.extend(ratios);
        Ok(findings)
    }

    fn load(&self) -> Result<Loaded, Failure> {
        let mut errors = Errors::default();
        let robot = self.config.robot(&mut errors).zip(self.config.realtime(&mut errors));
        let parameters = self.config.controller(&mut errors).zip(self.config.plant(&mut errors));
        let ((robot, realtime), (controller, plant)) = errors.finish(robot.zip(parameters))?;
        Ok(Loaded { robot, controller, plant, realtime })
    }

    /// Starts a controller of its own, does something with it and ends it.
    fn with_controller<T: Send>(
        &self,
        realtime: &RealtimeParameters,
        options: &[&str],
        work: impl FnOnce(&Instance) -> Result<T, BenchError> + Send,
    ) -> Result<T, Failure> {
        let instance = own_instance("controller")?.with_rate_hz(realtime.rate.hz());
        let _leftovers = instance.leftovers();
        let cannot = |error| Failure::new(format!("cannot start the controller: {error}"));
        let command = self.controller(&instance);
        let child =
            command.and_then(|mut command| command.args(options).stdin(Stdio::null()).stdout(Stdio::null()).spawn());
        let _ended = Ended(child.map_err(cannot)?);
        Ok(apart(|| work(&instance))??)
    }

    /// A controller of its own, yet to be started.
    fn controller(&self, instance: &Instance) -> std::io::Result<Command> {
        let mut command = Command::new(std::env::current_exe()?);
        command.arg("controller").args(self.config.arguments());
        command.args(["--instance", instance.name().as_str(), "--parent", &std::process::id().to_string()]);
        Ok(command)
    }
}

/// What is configured.
struct Loaded {
    robot: Robot,
    controller: controller::Parameters,
    plant: plant::Parameters,
    realtime: RealtimeParameters,
}

/// A process that is ended when dropped. It may wait for a plant that has gone, so it is not asked.
struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Where plant and controller run; the first two cores if nothing is configured.
fn cores(realtime: &RealtimeParameters) -> Result<[usize; 2], Failure> {
    let count = std::thread::available_parallelism().map_or(1, usize::from);
    let cores = [realtime.plant.core.unwrap_or(0), realtime.controller.core.unwrap_or(1)];
    match cores.iter().find(|core| **core >= count) {
        None => Ok(cores),
        Some(core) => Err(Failure::new(format!(
            "this needs core {core} (config/realtime.toml), and there are {count}: who waits awake needs a core of its own"
        ))),
    }
}

/// Does it in a thread of its own: what that asks of the system is not for this one, nor for the processes it starts.
fn apart<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let thread = std::thread::Builder::new().name("bench".to_owned()).stack_size(STACK);
    std::thread::scope(|threads| {
        let thread = thread.spawn_scoped(threads, work);
        let thread = thread.map_err(|error| Failure::new(format!("cannot start a thread: {error}")))?;
        Ok(thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

fn awake_on(core: usize) -> Scheduling {
    Scheduling { core: Some(core), lock_memory: true, ..Scheduling::default() }
}

fn own_instance(name: &str) -> Result<Instance, Failure> {
    Ok(Instance::new(&format!("bench-{name}-{}", std::process::id()))?)
}

impl From<BenchError> for Failure {
    fn from(error: BenchError) -> Self {
        Failure::new(error)
    }
}
