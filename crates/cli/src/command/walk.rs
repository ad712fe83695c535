//! `halfstep walk`: both processes, a script of commands, and pictures at the end.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use ::record::{RUN_FILE, files_of, merge};
use runtime::Rate;
use wire::{
    ConnectError, Instance, InstanceName, Intent, Leftovers, ObserverEnd, OperatorEnd, Request, Source, Verdict,
};

use super::{LoopOptions, print, print_line, write_pictures};
use crate::configuration::{ConfigOptions, Errors, Robot};
use crate::engine::{self, Engine};
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::operator::Operator;
use crate::picture;
use crate::process::Process;
use crate::progress::Progress;
use crate::run_log::RunLog;
use crate::script::{Reader, ScriptError, Step};
use crate::summary::{ControllerSummary, PlantSummary, WalkSummary};
use crate::words;

/// Walk: controller and plant as two processes, commands from a script, a recording and pictures
#[derive(Clone, Debug, clap::Args)]
pub struct Walk {
    #[command(flatten)]
    config: ConfigOptions,
    #[command(flatten)]
    runs: LoopOptions,
    /// Commands, one JSON object per line as for `stream`; a gentle mix is built in
    #[arg(long, value_name = "FILE")]
    commands: Option<PathBuf>,
    /// Folder for recording, summary and pictures; the next free one in runs/ if absent
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seed of the sensors' noise and of the errors of mass
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Pushes and sensor faults, as in config/disturbances_demo.toml
    #[arg(long, value_name = "FILE")]
    disturbances: Option<PathBuf>,
    /// Who simulates the robot: Halfstep itself, or MuJoCo, which is installed on first use
    #[arg(long, value_name = "NAME", default_value = "rust")]
    plant: Engine,
    /// Which robot, if others shall talk to it; a name of its own if absent
    #[arg(long, value_name = "NAME")]
    instance: Option<InstanceName>,
}

/// What is walked if no file is given.
const DEMO: &str = include_str!("../../../../config/commands_demo.jsonl");
const GLANCE: Duration = Duration::from_millis(10);
/// How many glances the controller may take to start.
const STARTUP_GLANCES: u32 = 1000;
/// How long one process may go on alone after the other has ended.
const ALONE: Duration = Duration::from_millis(500);

/// What is walking, and who listens. The instance's leftovers go last, when nobody is there any more.
struct Walking {
    controller: Process,
    plant: Process,
    operator: Operator,
    observer: ObserverEnd,
    _leftovers: Leftovers,
}

impl Walk {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let interrupt = Interrupt::listen()?;
        let mut errors = Errors::default();
        let robot = self.config.robot(&mut errors);
        self.config.controller(&mut errors);
        self.config.plant(&mut errors);
        let realtime = self.config.realtime(&mut errors);
        ConfigOptions::disturbances(self.disturbances.as_deref(), &mut errors);
        let rate = realtime.map(|realtime| realtime.rate).unwrap_or_default();
        let steps = self.steps(rate, &mut errors);
        let (robot, mut steps) = errors.finish(robot.zip(steps))?;
        if self.runs.from_stand {
            let walk = Request { intent: Some(Intent::Walk), ..Request::by(Source::Script) };
            steps.insert(0, Step { time: Some(Duration::ZERO), request: walk });
        }
        let instance = match &self.instance {
            Some(name) => Instance::new(name.as_str())?,
            None => Instance::new(&format!("walk-{}", std::process::id()))?,
        };
        if self.plant == Engine::Mujoco {
            engine::mujoco()?;
        }
        let folder = self.folder()?;

        let mut walking = self.start(&instance, &folder, &steps, rate)?;
        walking.watch(Progress::new(self.runs.ticks(rate), rate), &interrupt, rate)?;
        let (controller, plant) = walking.finish()?;

        let summary = self.conclude(&robot, rate, &instance, &folder, &controller, &plant)?;
        print(json, &summary)?;
        if !json {
            print_line(format_args!("run.mcap, summary.json and pictures are in {}", folder.display()))?;
        }
        Ok(Outcome::fine_if(summary.measures.falls == 0))
    }

    /// The script, as far as this walk gets.
    fn steps(&self, rate: Rate, errors: &mut Errors) -> Option<Vec<Step>> {
        let steps = match &self.commands {
            None => Reader::read_all("built-in commands", DEMO),
            Some(file) => {
                let name = file.display().to_string();
                let text = errors.note(fs::read_to_string(file).map_err(|error| format!("{name}: {error}")))?;
                Reader::read_all(name, &text)
            }
        };
        let is_reached = |step: &Step| self.runs.ticks(rate).is_none_or(|ticks| step.tick(rate) < ticks);
        match steps {
            Ok(steps) => Some(steps.into_iter().filter(is_reached).collect()),
            Err(wrong) => {
                errors.0.extend(wrong.iter().map(ScriptError::to_string));
                None
            }
        }
    }

    /// Where to write.
    fn folder(&self) -> Result<PathBuf, Failure> {
        let cannot = |folder: &Path, error| Failure::new(format!("{}: {error}", folder.display()));
        if let Some(folder) = &self.out {
            fs::create_dir_all(folder).map_err(|error| cannot(folder, error))?;
            return Ok(folder.clone());
        }
        let runs = Path::new("runs");
        fs::create_dir_all(runs).map_err(|error| cannot(runs, error))?;
        for number in 1.. {
            let folder = runs.join(format!("{number:04}"));
            match fs::create_dir(&folder) {
                Ok(()) => return Ok(folder),
                Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(cannot(&folder, error)),
            }
        }
        unreachable!("numbers do not end")
    }

    /// Starts the controller, asks it for everything that is to come, and only then starts the plant, which begins the
    /// walk: so every request is there in time.
    fn start(&self, instance: &Instance, folder: &Path, steps: &[Step], rate: Rate) -> Result<Walking, Failure> {
        let leftovers = instance.leftovers();
        let mut controller = Process::start("controller", self.arguments(instance, folder))?;
        let operator = connect_operator(instance, &mut controller)?;
        let observer = ObserverEnd::connect(instance)?;
        let mut operator = Operator::new(operator, steps, rate);
        operator.send()?;
        let mut of_plant = self.arguments(instance, folder);
        of_plant.extend(["--end-when-fallen".into(), "--seed".into(), self.seed.to_string().into()]);
        of_plant.extend(["--engine".into(), self.plant.name().into()]);
        if let Some(file) = &self.disturbances {
            of_plant.extend(["--disturbances".into(), file.into()]);
        }
        let plant = Process::start("plant", of_plant)?;
        Ok(Walking { controller, plant, operator, observer, _leftovers: leftovers })
    }

    /// What both processes are told.
    fn arguments(&self, instance: &Instance, folder: &Path) -> Vec<OsString> {
        let mut arguments = self.config.arguments();
        arguments.extend(["--instance".into(), instance.name().as_str().into(), "--out".into(), folder.into()]);
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
    ) -> Result<WalkSummary, Failure> {
        let parts = files_of(folder)?;
        let whole = folder.join(RUN_FILE);
        merge(&parts, &whole)?;
        // They hold nothing more.
        parts.iter().for_each(|part| drop(fs::remove_file(part)));
        let log = RunLog::read(&whole)?;
        let duration_s = rate.time(plant.ticks);
        let summary = WalkSummary {
            measures: log.measures(&robot.mechanism),
            requests: controller.requests,
            duration_s,
            seed: self.seed,
            plant: self.plant.name(),
            instance: instance.name().to_string(),
            clock: self.runs.clock().text(),
            deadline_misses: controller.deadline_misses + plant.deadline_misses,
            kept_time: controller.kept_time,
            log_gaps: controller.log_gaps + plant.log_gaps,
            real_time_factor: if plant.wall_s > 0.0 { duration_s / plant.wall_s } else { 0.0 },
        };
        let text = serde_json::to_string_pretty(&summary).map_err(Failure::new)?;
        let file = folder.join("summary.json");
        fs::write(&file, text + "\n").map_err(|error| Failure::new(format!("{}: {error}", file.display())))?;
        write_pictures(folder, &picture::of_run(&log, &robot.mechanism))?;
        Ok(summary)
    }
}

/// Waits until the controller takes requests.
fn connect_operator(instance: &Instance, controller: &mut Process) -> Result<OperatorEnd, Failure> {
    for _ in 0..STARTUP_GLANCES {
        match OperatorEnd::connect(instance) {
            Err(ConnectError::NoController { .. }) if !controller.has_ended()? => std::thread::sleep(GLANCE),
            Err(ConnectError::NoController { .. }) => return Err(Failure::new("the controller failed to start")),
            connected => return Ok(connected?),
        }
    }
    Err(Failure::new("the controller does not start"))
}

impl Walking {
    /// Shows the walk until one of the processes ends, or this one is asked to.
    fn watch(&mut self, progress: Progress, interrupt: &Interrupt, rate: Rate) -> Result<(), Failure> {
        while !(self.plant.has_ended()? || self.controller.has_ended()?) {
            if interrupt.is_raised() {
                self.plant.end();
                self.controller.end();
                break;
            }
            self.operator.send()?;
            self.tell_objections(&progress, rate);
            let mut newest = None;
            while let Some(report) = self.observer.reports.next_report()? {
                newest = Some(report);
            }
            if let Some(report) = newest.and_then(|report| report.checked().ok()) {
                progress.show(&report);
            }
            std::thread::sleep(GLANCE);
        }
        self.tell_objections(&progress, rate);
        Ok(())
    }

    /// Says what was not granted as asked.
    fn tell_objections(&mut self, progress: &Progress, rate: Rate) {
        while let Some((request, reply)) = self.operator.next_reply() {
            if reply.verdict != Verdict::Accepted {
                let time = rate.time(request.not_before);
                progress.say(&format!("at {time:.2} s: {}", words::reply(&request, &reply)));
            }
        }
    }

    /// Waits for the other process, too, and gives what both have to say.
    fn finish(self) -> Result<(ControllerSummary, PlantSummary), Failure> {
        let plant = self.plant.finish(ALONE);
        let controller = self.controller.finish(ALONE);
        Ok((controller?, plant?))
    }
}
