//! `halfstep walk`: both processes, a script of commands, and pictures at the end.

use interface::{Intent, Rate, Reason, Request, Source, Verdict};
use std::ffi::OsString;
use std::fs;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::Duration;

use dialogue::reply_text::{reply_text, request_text};
use dialogue::script::{Reader, ScriptError, TimedRequest};
use gait::Robot;
use node::configuration::Errors;
use node::engine;
use node::interrupt::Interrupt;
use node::summary::{ControllerSummary, PlantSummary};
use node::tell::tell;
use operator::script_runner::ScriptRunner;
use plots::picture::{self, FloorHeights};
use plots::run_log::RunLog;
use plots::run_page::run_page;
use plots::run_summary::RunSummary;
use record::{RUN_FILE, files_of, merge, provenance_of, set_folder_aside};
use wire::{ConnectError, Instance, InstanceName, Leftovers, ObserverPorts, OperatorPorts};

use super::config_options::ConfigOptions;
use super::engine::Engine;
use super::options::{LoopOptions, path_option};
use crate::error::CliError;
use crate::output::print;
use crate::output_folder::OutputFolder;
use crate::process::Process;
use crate::progress::Progress;
use crate::recorded_floor::{floor_of, recorded_ground};
use crate::status::Status;
use crate::walk_summary::{SummaryInFolder, WalkSummary};

/// Walk: run controller and plant, send commands from a script, record the run and plot it
#[derive(Clone, Debug, clap::Args)]
pub(super) struct WalkArgs {
    #[command(flatten)]
    config: ConfigOptions,
    #[command(flatten)]
    runs: LoopOptions,
    /// Commands, one JSON object per line as for `stream` [default: a built-in demo]
    #[arg(long, value_name = "FILE")]
    commands: Option<PathBuf>,
    /// Folder for recording, summary and plots [default: the next free one in runs/]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seed of sensor noise and mass errors
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Pushes and sensor faults, as in config/disturbances_demo.toml
    #[arg(long, value_name = "FILE")]
    disturbances: Option<PathBuf>,
    /// Physics engine; MuJoCo is installed on first use
    #[arg(long, value_name = "NAME", default_value = "rust")]
    plant: Engine,
    /// Instance name for other processes to connect to [default: unique per run]
    #[arg(long, value_name = "NAME")]
    instance: Option<InstanceName>,
    /// Show the robot in the browser, with means to drive and to push it: prints the address of the page, see `view`
    #[arg(long)]
    view: bool,
    /// Walk on after a fall: 2 s later the robot is put back on its feet, where it began, and held there until a reset;
    /// --view does so, too
    #[arg(long)]
    lift_when_fallen: bool,
}

/// The commands if no file is given.
const DEMO: &str = include_str!("../../../../config/commands_demo.jsonl");
const POLL_INTERVAL: Duration = Duration::from_millis(10);
/// Polls until processes that are leaving must have left.
const LEAVING_POLLS: u32 = 200;
/// Polls until the controller must have started.
const STARTUP_POLLS: u32 = 1000;
/// How long one process may go on after the other has ended.
const END_TIMEOUT: Duration = Duration::from_millis(500);

/// The two processes, and the connections to them. The instance's files are removed last, when no process uses them.
struct Walking {
    controller: Process,
    plant: Process,
    script: ScriptRunner,
    observer: ObserverPorts,
    _view: Option<Process>,
    _leftovers: Leftovers,
}

impl WalkArgs {
    pub(super) fn run(mut self, json: bool) -> Result<Status, CliError> {
        self.config.resolve()?;
        let interrupt = Interrupt::listen()?;
        let mut errors = Errors::default();
        let files = self.config.files();
        let robot = files.robot(&mut errors);
        files.controller(&mut errors);
        files.plant(&mut errors);
        let realtime = files.realtime(&mut errors);
        files.disturbances(self.disturbances.as_deref(), &mut errors);
        let rate = realtime.map_or(Rate::clamped(wire::DEFAULT_RATE_HZ), |realtime| realtime.rate);
        let steps = self.steps(rate, &mut errors);
        let (robot, mut steps) = errors.finish(robot.zip(steps))?;
        if self.runs.from_stand {
            let walk = Request { intent: Some(Intent::Walk), ..Request::new(Source::Script) };
            steps.insert(0, TimedRequest { time: Some(Duration::ZERO), request: walk });
        }
        let instance = match &self.instance {
            Some(name) => Instance::new(name.as_str())?,
            None => Instance::new(&format!("walk-{}", std::process::id()))?,
        };
        if self.plant == Engine::Mujoco {
            engine::mujoco()?;
        }
        // Else the script would be sent to the other controller.
        if self.instance.is_some() && stays_taken(&instance) {
            let instance = instance.name().to_string();
            return Err(ConnectError::AlreadyRunning { role: "controller", instance }.into());
        }
        let folder = self.folder()?;

        let mut walking = self.start(&instance, &folder, &steps, rate)?;
        if self.instance.is_none() {
            tell(format_args!("walks as instance `{}`: halfstep send --instance {0} stop", instance.name()));
        }
        walking.watch(Progress::new(self.runs.ticks(rate), rate), &interrupt, rate)?;
        let (controller, plant) = walking.finish()?;

        let summary = self.conclude(&robot, rate, &instance, &folder, &controller, &plant)?;
        print(json, &SummaryInFolder { folder: &folder, summary: &summary })?;
        let walked = summary.measures.falls == 0 && !summary.is_faulted();
        Ok(Status::success_if(walked && summary.problems.is_empty()))
    }

    /// The requests of the script that are due before the walk ends.
    fn steps(&self, rate: Rate, errors: &mut Errors) -> Option<Vec<TimedRequest>> {
        let steps = match &self.commands {
            None => Reader::read_all("built-in commands", DEMO.as_bytes()),
            Some(file) => {
                let name = file.display().to_string();
                let input = errors.note(fs::File::open(file).map_err(|error| format!("{name}: {error}")))?;
                Reader::read_all(name, BufReader::new(input))
            }
        };
        let is_reached = |step: &TimedRequest| self.runs.ticks(rate).is_none_or(|ticks| step.tick(rate) < ticks);
        match steps {
            Ok(steps) => Some(steps.into_iter().filter(is_reached).collect()),
            Err(wrong) => {
                errors.0.extend(wrong.iter().map(ScriptError::to_string));
                None
            }
        }
    }

    /// Folder for the results.
    fn folder(&self) -> Result<PathBuf, CliError> {
        if let Some(folder) = &self.out {
            if let Some(aside) = set_folder_aside(folder)? {
                tell(format_args!("{}: held an earlier run, which is in {} now", folder.display(), aside.display()));
            }
            fs::create_dir_all(folder).map_err(CliError::file(folder))?;
            return Ok(folder.clone());
        }
        let runs = Path::new("runs");
        fs::create_dir_all(runs).map_err(CliError::file(runs))?;
        for number in 1.. {
            let folder = runs.join(format!("{number:04}"));
            match fs::create_dir(&folder) {
                Ok(()) => return Ok(folder),
                Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(CliError::file(&folder)(error)),
            }
        }
        unreachable!("numbers do not end")
    }

    /// Starts the controller, sends it the script, and only then starts the plant, which begins the walk: so every
    /// request arrives in time.
    fn start(
        &self,
        instance: &Instance,
        folder: &Path,
        steps: &[TimedRequest],
        rate: Rate,
    ) -> Result<Walking, CliError> {
        let leftovers = instance.leftovers();
        let mut controller = Process::start("controller", self.arguments(instance, folder))?;
        let operator = connect_operator(instance, &mut controller)?;
        let observer = ObserverPorts::connect(instance)?;
        let mut script = ScriptRunner::new(operator, steps, rate);
        script.send()?;
        let view = self.view.then(|| Process::start("view", self.arguments_of_view(instance))).transpose()?;
        let mut of_plant = self.arguments(instance, folder);
        // Who looks on can bring the robot back to a stand with a reset.
        let after_fall = if self.view || self.lift_when_fallen { "--lift-when-fallen" } else { "--end-when-fallen" };
        of_plant.extend([after_fall.into(), "--seed".into(), self.seed.to_string().into()]);
        of_plant.extend(["--engine".into(), self.plant.name().into()]);
        if let Some(file) = &self.disturbances {
            of_plant.push(path_option("--disturbances", file));
        }
        let plant = Process::start("plant", of_plant)?;
        Ok(Walking { controller, plant, script, observer, _view: view, _leftovers: leftovers })
    }

    /// Arguments of the process that serves the page.
    fn arguments_of_view(&self, instance: &Instance) -> Vec<OsString> {
        let mut arguments = self.config.arguments();
        arguments.push(format!("--instance={}", instance.name()).into());
        arguments
    }

    /// Arguments of both processes.
    fn arguments(&self, instance: &Instance, folder: &Path) -> Vec<OsString> {
        let mut arguments = self.config.arguments();
        arguments.extend([format!("--instance={}", instance.name()).into(), path_option("--out", folder)]);
        if let Some(duration) = self.runs.duration {
            arguments.extend(["--for".into(), humantime::format_duration(duration).to_string().into()]);
        }
        if self.runs.lockstep {
            arguments.push("--lockstep".into());
        }
        if self.runs.from_stand {
            arguments.push("--from-stand".into());
        }
        arguments
    }

    /// Writes summary and pictures.
    fn conclude(
        &self,
        robot: &Robot,
        rate: Rate,
        instance: &Instance,
        folder: &Path,
        controller: &ControllerSummary,
        plant: &PlantSummary,
    ) -> Result<WalkSummary, CliError> {
        let mut problems: Vec<String> = plant.unstable.iter().cloned().collect();
        let unrecorded = [("controller", &controller.record_error), ("plant", &plant.record_error)];
        problems.extend(unrecorded.iter().filter_map(|(role, error)| {
            error.as_ref().map(|error| format!("the {role} did not record the run to its end: {error}"))
        }));
        let parts = files_of(folder)?;
        let whole = folder.join(RUN_FILE);
        match merge(&parts, &whole) {
            // The merged recording has everything that they have.
            Ok(()) => parts.iter().filter(|part| **part != whole).for_each(|part| drop(fs::remove_file(part))),
            Err(error) => problems.push(format!(
                "the two recordings stay apart, in {}, where replay and plot find them: {error}",
                folder.display()
            )),
        }
        let log = RunLog::read(folder)?;
        log.notes.iter().for_each(tell);
        let duration_s = rate.time(plant.ticks);
        let mut summary = WalkSummary {
            measures: log.measures(&robot.mechanism),
            mode: controller.mode.clone(),
            // The plant may end first: that nothing is measured then is no fault.
            fault: controller.fault.clone().filter(|fault| fault.time_s <= duration_s),
            requests: controller.requests,
            duration_s,
            seed: self.seed,
            plant: self.plant.name(),
            floor: plant.floor.clone(),
            instance: instance.name().to_string(),
            clock: self.runs.clock().text(),
            deadline_misses: controller.deadline_misses + plant.deadline_misses,
            timing: controller.timing,
            setpoint_hash: controller.setpoint_hash.clone(),
            log_gaps: controller.log_gaps + plant.log_gaps,
            problems,
            real_time_factor: if plant.wall_s > 0.0 { duration_s / plant.wall_s } else { 0.0 },
        };
        let text = serde_json::to_string_pretty(&summary).map_err(CliError::new)?;
        let mut files = vec![("summary.json", text + "\n")];
        let origin = provenance_of(folder)?;
        // The parameters were checked before the walk began.
        let floor = recorded_ground(&origin)?.map_or(FloorHeights::PLANE, floor_of);
        let pictures = picture::of_run(&log, &robot.mechanism, &floor);
        let of_run = RunSummary::of(&log, &robot.mechanism);
        let name = folder.display().to_string();
        files.push(("index.html", run_page(&name, &of_run, &pictures, &log.notes, &origin)));
        files.extend(pictures.drawn.into_iter().map(|picture| (picture.file, picture.svg)));
        // Without room for them the summary is printed at least.
        if let Err(error) = OutputFolder::open(folder, true).and_then(|out| out.write(&files)) {
            summary.problems.push(error.to_string());
        }
        Ok(summary)
    }
}

/// Whether an instance has a controller or plant that does not leave within two seconds, as one does whose walk was
/// killed.
fn stays_taken(instance: &Instance) -> bool {
    (0..LEAVING_POLLS).all(|_| {
        let is_taken = instance.is_in_use();
        if is_taken {
            std::thread::sleep(POLL_INTERVAL);
        }
        is_taken
    })
}

/// Waits until the controller takes requests.
fn connect_operator(instance: &Instance, controller: &mut Process) -> Result<OperatorPorts, CliError> {
    for _ in 0..STARTUP_POLLS {
        match OperatorPorts::connect(instance) {
            Err(ConnectError::NoController { .. }) if !controller.has_ended()? => std::thread::sleep(POLL_INTERVAL),
            Err(ConnectError::NoController { .. }) => return Err(CliError::new("the controller failed to start")),
            connected => return Ok(connected?),
        }
    }
    Err(CliError::new("the controller does not start"))
}

impl Walking {
    /// Shows the walk until one of the processes ends, or this one is asked to.
    fn watch(&mut self, progress: Progress, interrupt: &Interrupt, rate: Rate) -> Result<(), CliError> {
        while !(self.plant.has_ended()? || self.controller.has_ended()?) {
            if interrupt.is_raised() {
                self.plant.end();
                self.controller.end();
                break;
            }
            self.script.send()?;
            self.print_objections(&progress, rate);
            let mut newest = None;
            while let Some(report) = self.observer.reports.next_report()? {
                newest = Some(report);
            }
            if let Some(message) = newest
                && let Ok(report) = message.checked()
            {
                progress.show(message.tick, &report);
            }
            std::thread::sleep(POLL_INTERVAL);
        }
        self.print_objections(&progress, rate);
        Ok(())
    }

    /// Prints the replies to requests that were not granted as requested.
    fn print_objections(&mut self, progress: &Progress, rate: Rate) {
        while let Some((request, reply)) = self.script.next_reply() {
            // At its end the controller refuses what still waits for its tick.
            if reply.verdict != Verdict::Accepted && reply.reason != Reason::ShuttingDown {
                let (time, asked) = (rate.time(request.not_before), request_text(&request));
                progress.print(&format!("at {time:.2} s, {asked}: {}", reply_text(&request, &reply)));
            }
        }
    }

    /// Waits for the other process to end, and returns both summaries.
    fn finish(self) -> Result<(ControllerSummary, PlantSummary), CliError> {
        let plant = self.plant.finish(END_TIMEOUT);
        let controller = self.controller.finish(END_TIMEOUT);
        Ok((controller?, plant?))
    }
}
