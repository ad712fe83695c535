//! `halfstep bench`: benchmarks on this machine, against references in the same run.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use ::bench::compute::{ComputeOptions, compute};
use ::bench::control_latency::{self, ControlLatencyOptions};
use ::bench::exchange::{ExchangeOptions, answer, exchange};
use ::bench::jitter::{JitterOptions, jitter};
use ::bench::observed_jitter::{Commands, ObservedJitterOptions, observed_jitter};
use ::bench::page::bench_page;
use ::bench::{BenchError, BenchReport, RatioVerdict};
use clap::Subcommand;
use gait::Robot;
use node::configuration::Errors;
use node::realtime::RealtimeParameters;
use node::tell::is_quiet;
use plant::Plant;
use runtime::Scheduling;
use wire::{Instance, InstanceName};

use super::config_options::ConfigOptions;
use super::options::duration;
use crate::error::CliError;
use crate::messages::complain;
use crate::output::{print, print_line};
use crate::output_folder::OutputFolder;
use crate::process::Process;
use crate::status::Status;
use crate::work_progress::WorkProgress;

/// Benchmark on this machine, against reference implementations in the same run
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "A time says something about the machine; the verdict is a ratio of two numbers of one run. \
Nothing else should run meanwhile.")]
#[command(mut_args(anywhere))]
pub(super) struct BenchArgs {
    #[command(flatten)]
    config: ConfigOptions,
    /// Also write bench.html, with histograms, and bench.json into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace an earlier benchmark in the folder
    #[arg(long)]
    force: bool,
    /// End with exit code 1 if a ratio misses its bound
    #[arg(long)]
    strict: bool,
    #[command(subcommand)]
    what: What,
}

#[derive(Clone, Debug, Subcommand)]
enum What {
    /// Inverse dynamics, plant step, controller tick and plan
    Compute {
        /// Number of interleaved rounds
        #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..))]
        rounds: u32,
        /// Duration of each round
        #[arg(long, alias = "turn", value_name = "DURATION", value_parser = duration, default_value = "300ms")]
        slice: Duration,
    },
    /// Exchange between two processes, against iceoryx2 and plain shared memory; latency of the controller
    Latency {
        /// Number of interleaved rounds
        #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
        rounds: u32,
        /// Round trips per round, without pause
        #[arg(long, value_name = "N", default_value_t = 20_000, value_parser = clap::value_parser!(u64).range(1..))]
        trips: u64,
        /// Requests to the controller, one every 1.35 s
        #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
        requests: u32,
    },
    /// Wake-up latency of the loop, against cyclictest or a bare loop; the controller with and without recorder,
    /// observers and a page
    Jitter {
        /// Number of interleaved rounds
        #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u32).range(1..))]
        segments: u32,
        /// Duration of each round; 5s for figures to quote
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

/// How long before its deadline the spinning loop of `jitter` stops sleeping if realtime.toml has no time for it.
const SPIN: Duration = Duration::from_micros(150);
/// Size of a thread's stack, as a process's main thread has it (bytes): controllers are large values.
const STACK: usize = 8 << 20;
/// Round trips per round at the control rate.
const TRIPS_AT_PACE: u64 = 500;
/// Periods of the controller in lockstep.
const FLAT_OUT: u64 = 20_000;

/// Names of the files in the folder.
const FILES: [&str; 2] = ["bench.html", "bench.json"];

/// Permits an option behind the benchmark's name, too.
fn anywhere(option: clap::Arg) -> clap::Arg {
    option.global(true)
}

impl BenchArgs {
    pub(super) fn run(mut self, json: bool) -> Result<Status, CliError> {
        self.config.resolve()?;
        let out = self.out.as_deref().map(|out| OutputFolder::open(out, self.force)).transpose()?;
        out.as_ref().map_or(Ok(()), |out| out.require_none(&FILES))?;
        let report = match &self.what {
            What::Answer { instance, core, priority } => {
                let scheduling = Scheduling { priority: *priority, ..awake_on(*core) };
                answer(&Instance::new(instance.as_str())?, &scheduling)?;
                return Ok(Status::Success);
            }
            What::Compute { rounds, slice } => self.compute(*rounds, *slice)?,
            What::Latency { rounds, trips, requests } => self.latency(*rounds, *trips, *requests)?,
            What::Jitter { segments, segment } => self.jitter(*segments, *segment)?,
        };
        // What took minutes is printed also if it cannot be written any more.
        print(json, &report)?;
        // On a busy machine a ratio that does not pass is no failure.
        let is_missed = report.ratios.iter().any(|ratio| ratio.verdict() == RatioVerdict::Missed);
        let status = Status::success_if(!(self.strict && is_missed));
        let Some(folder) = &out else { return Ok(status) };
        let text = serde_json::to_string_pretty(&report).map_err(CliError::new)? + "\n";
        let [page_file, json_file] = FILES;
        if let Err(error) = folder.write(&[(page_file, bench_page(&report)), (json_file, text)]) {
            complain(error);
            return Ok(Status::Failure);
        }
        if !json {
            print_line(format_args!("written to {}", folder.join(page_file).display()))?;
        }
        Ok(status)
    }

    fn compute(&self, rounds: u32, slice: Duration) -> Result<BenchReport, CliError> {
        let Loaded { robot, controller, plant, realtime } = self.load()?;
        let Scheduling { core, lock_memory, .. } = realtime.controller;
        let options = ComputeOptions {
            mechanism: robot.mechanism,
            nominal: robot.nominal,
            controller,
            plant,
            rounds,
            slice,
            period: realtime.rate.period_s(),
            scheduling: Scheduling { core, lock_memory, ..Scheduling::default() },
        };
        let progress = WorkProgress::new("bench compute", rounds.into());
        Ok(in_own_thread(|| compute(&options, || progress.part_done()))??)
    }

    fn latency(&self, rounds: u32, trips: u64, requests: u32) -> Result<BenchReport, CliError> {
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
        let progress = WorkProgress::new("bench latency, exchange", rounds.into());
        let mut report = in_own_thread(|| exchange(&options, &instance, answering, || progress.part_done()))??;
        drop(progress);

        let options =
            ControlLatencyOptions { rate: realtime.rate, requests, in_lockstep: FLAT_OUT, scheduling: scheduling[0] };
        let start = robot.nominal.at(0.0);
        let new_plant = || Plant::new(&robot.mechanism, &parameters, &start, realtime.rate.period_s(), 1);
        let progress = WorkProgress::new("bench latency, controller in real time and in lockstep", 2);
        let in_realtime = self.with_controller(&realtime, &[], |instance| {
            control_latency::in_realtime(&options, instance, &robot.mechanism, &mut new_plant())
        })?;
        progress.part_done();
        let in_lockstep = self.with_controller(&realtime, &["--lockstep"], |instance| {
            control_latency::in_lockstep(&options, instance, &robot.mechanism, &mut new_plant())
        })?;
        report.series.extend(in_realtime.series.into_iter().chain([in_lockstep]));
        report.ratios.extend(in_realtime.ratios);
        report.notes.extend(in_realtime.notes);
        Ok(report)
    }

    fn jitter(&self, segments: u32, segment: Duration) -> Result<BenchReport, CliError> {
        let Loaded { robot, plant: parameters, realtime, .. } = self.load()?;
        let [busy, core] = cores(&realtime)?;
        let spin = if realtime.spin.is_zero() { SPIN } else { realtime.spin };
        let options = JitterOptions {
            segments,
            segment,
            period: realtime.rate.period(),
            spin,
            scheduling: Scheduling { core: Some(core), ..realtime.controller },
            busy_core: (busy != core).then_some(busy),
        };
        let progress = WorkProgress::new("bench jitter, loops", segments.into());
        let mut report = jitter(&options, || progress.part_done())?;
        drop(progress);

        let options =
            ObservedJitterOptions { rate: realtime.rate, loop_core: realtime.controller.core, segments, segment };
        let instance = own_instance("watched")?.with_rate_hz(realtime.rate.hz());
        let controller = |folder: Option<&Path>| {
            let mut command = self.controller(&instance)?;
            command.args(folder.into_iter().flat_map(|folder| [OsStr::new("--out"), folder.as_os_str()]));
            Ok(command)
        };
        let start = robot.nominal.at(0.0);
        let new_plant = || Plant::new(&robot.mechanism, &parameters, &start, realtime.rate.period_s(), 1);
        let viewer = || {
            let mut command = Command::new(std::env::current_exe()?);
            command.arg("view").args(self.config.arguments()).args(["--instance", instance.name().as_str()]);
            command.args(["--listen", "127.0.0.1:0", "--json", "--quiet"]);
            Ok(command)
        };
        let commands = Commands { controller: &controller, viewer: &viewer };
        let progress = WorkProgress::new("bench jitter, controllers", segments.into());
        let after = || progress.part_done();
        let (series, ratios) =
            in_own_thread(|| observed_jitter(&options, &instance, &commands, &robot.mechanism, new_plant, after))??;
        report.series.extend(series);
        report.ratios.extend(ratios);
        Ok(report)
    }

    fn load(&self) -> Result<Loaded, CliError> {
        let mut errors = Errors::default();
        let files = self.config.files();
        let robot = files.robot(&mut errors).zip(files.realtime(&mut errors));
        let parameters = files.controller(&mut errors).zip(files.plant(&mut errors));
        let ((robot, realtime), (controller, plant)) = errors.finish(robot.zip(parameters))?;
        Ok(Loaded { robot, controller, plant, realtime })
    }

    /// Runs `work` with a controller process of its own.
    fn with_controller<T: Send>(
        &self,
        realtime: &RealtimeParameters,
        options: &[&str],
        work: impl FnOnce(&Instance) -> Result<T, BenchError> + Send,
    ) -> Result<T, CliError> {
        let instance =
            own_instance("controller")?.with_rate_hz(realtime.rate.hz()).with_lockstep(options.contains(&"--lockstep"));
        let _leftovers = instance.leftovers();
        let arguments =
            self.config.arguments().into_iter().chain(["--instance".into(), instance.name().as_str().into()]);
        let _controller = Process::start("controller", arguments.chain(options.iter().map(Into::into)))?;
        Ok(in_own_thread(|| work(&instance))??)
    }

    /// The command that starts a controller process.
    fn controller(&self, instance: &Instance) -> std::io::Result<Command> {
        let mut command = Command::new(std::env::current_exe()?);
        command.arg("controller").args(self.config.arguments());
        command.args(["--instance", instance.name().as_str(), "--parent", &std::process::id().to_string()]);
        command.args(is_quiet().then_some("--quiet"));
        Ok(command)
    }
}

/// The loaded configuration.
struct Loaded {
    robot: Robot,
    controller: controller::Parameters,
    plant: plant::PlantParameters,
    realtime: RealtimeParameters,
}

/// Cores of plant and controller; the first two if none are configured.
fn cores(realtime: &RealtimeParameters) -> Result<[usize; 2], CliError> {
    let count = std::thread::available_parallelism().map_or(1, usize::from);
    let cores = [realtime.plant.core.unwrap_or(0), realtime.controller.core.unwrap_or(1)];
    match cores.iter().find(|core| **core >= count) {
        None => Ok(cores),
        Some(core) => Err(CliError::new(format!(
            "needs core {core} (config/realtime.toml), but only {count} are available; busy-waiting threads need a \
             dedicated core"
        ))),
    }
}

/// Runs `work` in a thread of its own, so that the scheduling that it asks for does not apply to this thread and to the
/// processes that it starts.
fn in_own_thread<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, CliError> {
    let thread = std::thread::Builder::new().name("bench".to_owned()).stack_size(STACK);
    std::thread::scope(|threads| {
        let thread = thread.spawn_scoped(threads, work);
        let thread = thread.map_err(|error| CliError::new(format!("cannot start a thread: {error}")))?;
        Ok(thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

fn awake_on(core: usize) -> Scheduling {
    Scheduling { core: Some(core), lock_memory: true, ..Scheduling::default() }
}

fn own_instance(name: &str) -> Result<Instance, CliError> {
    Ok(Instance::new(&format!("bench-{name}-{}", std::process::id()))?)
}

impl From<BenchError> for CliError {
    fn from(error: BenchError) -> Self {
        CliError::new(error)
    }
}
