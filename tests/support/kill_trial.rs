//! One `kill -9` of a process of a pair, in a phase of the walk, and what it leaves behind.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use interface::{GaitChange, Intent, Mode, Request, Source};
use record::Recording;
use wire::{ObserverPorts, OperatorPorts};

use crate::command_line::{CommandLine, Running};

/// What is killed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Victim {
    /// `halfstep controller`
    Controller,
    /// `halfstep plant`
    Plant,
    /// `halfstep walk`, with its children
    Walk,
    /// `halfstep send`
    Send,
    /// `halfstep stream` that commands
    Stream,
    /// `halfstep stream` that only listens
    Observer,
}

/// When it is killed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// In the first tenth of a second of its start.
    Starting,
    /// While the robot walks.
    Walking,
    /// While a request is evaluated.
    Requested,
    /// After a stop.
    Standing,
    /// After a hold.
    Holding,
    /// While the robot steps in place.
    InPlace,
    /// While it ends.
    Exiting,
    /// After a fall.
    Fallen,
}

/// What was wrong after a kill; empty if nothing was.
#[derive(Clone, Debug, Default)]
pub struct Aftermath {
    /// A process could not be started again, did not answer, or did not end.
    pub stuck: Vec<String>,
    /// Files that are left after the next start of another instance.
    pub leaked: Vec<String>,
    /// Recordings that cannot be read.
    pub unreadable: Vec<String>,
    /// Recordings that replay to other setpoints.
    pub wrong: Vec<String>,
}

impl Victim {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Controller, Self::Plant, Self::Walk, Self::Send, Self::Stream, Self::Observer];
}

impl Phase {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Starting,
        Self::Walking,
        Self::Requested,
        Self::Standing,
        Self::Holding,
        Self::InPlace,
        Self::Exiting,
        Self::Fallen,
    ];
}

impl Aftermath {
    /// Whether nothing was wrong.
    pub fn is_clean(&self) -> bool {
        [&self.stuck, &self.leaked, &self.unreadable, &self.wrong].iter().all(|texts| texts.is_empty())
    }
}

/// Nothing that works takes so long, even on a loaded machine.
const SAFETY: Duration = Duration::from_secs(30);
const GLANCE: Duration = Duration::from_millis(2);
/// A push that no controller survives.
const PUSH: &str = "[[push]]\nat_s = 0.3\nlasts_s = 0.1\nimpulse_n_s = [0, 400, 0]\n";

/// Kills the victim in the phase, after a further `delay`, and looks at what is left.
pub fn kill(command_line: &CommandLine, victim: Victim, phase: Phase, delay: Duration) -> Aftermath {
    let mut trial = Trial { command_line, aftermath: Aftermath::default() };
    match victim {
        Victim::Walk => trial.walk(phase, delay),
        Victim::Controller | Victim::Plant => trial.loops(victim, phase, delay),
        Victim::Send | Victim::Stream | Victim::Observer => trial.clients(victim, phase, delay),
    }
    trial.sweep();
    trial.read_recordings();
    trial.aftermath
}

struct Trial<'a> {
    command_line: &'a CommandLine,
    aftermath: Aftermath,
}

impl Trial<'_> {
    /// The words that start a loop. Each recording has a folder of its own.
    fn words(role: &str, phase: Phase, run: u32) -> String {
        let stand = if phase == Phase::Standing { " --from-stand" } else { "" };
        let push = if role == "plant" && phase == Phase::Fallen { " --disturbances push.toml" } else { "" };
        format!("{role} --out {role}-{run}{stand}{push}")
    }

    fn pair(&mut self, phase: Phase) -> Option<[Running; 2]> {
        fs::write(self.command_line.folder().join("push.toml"), PUSH).expect("a folder to write in");
        let controller = self.command_line.start_here(&Self::words("controller", phase, 0));
        self.wait_for_controller("at first")?;
        let plant = self.command_line.start_here(&Self::words("plant", phase, 0));
        Some([controller, plant])
    }

    fn wait_for_controller(&mut self, when: &str) -> Option<()> {
        let began = Instant::now();
        loop {
            match OperatorPorts::connect(self.command_line.wire_instance()) {
                Ok(_) => return Some(()),
                Err(error) if began.elapsed() > SAFETY => {
                    self.aftermath.stuck.push(format!("{when}: {error}"));
                    return None;
                }
                Err(_) => std::thread::sleep(GLANCE),
            }
        }
    }

    /// Brings the robot into a phase.
    fn reach(&mut self, phase: Phase) {
        let (intent, mode) = match phase {
            Phase::Starting | Phase::Exiting => return,
            Phase::Requested | Phase::Walking => (None, Mode::Walking),
            Phase::Standing => (None, Mode::Standing),
            Phase::Holding => (Some(Intent::Hold), Mode::Holding),
            Phase::InPlace => (Some(Intent::InPlace), Mode::InPlace),
            Phase::Fallen => (None, Mode::Fallen),
        };
        let instance = self.command_line.wire_instance();
        let Ok(operator) = OperatorPorts::connect(instance) else { return };
        let Ok(mut observer) = ObserverPorts::connect(instance) else { return };
        if let Some(intent) = intent {
            let request = Request { intent: Some(intent), ..Request::new(Source::Console) };
            let _ = operator.requests.ask(&(&request).into(), SAFETY);
        }
        let began = Instant::now();
        while began.elapsed() < SAFETY {
            let report = observer.reports.next_report().ok().flatten().and_then(|report| report.checked().ok());
            if report.is_some_and(|report| report.mode == mode) {
                break;
            }
            std::thread::sleep(Duration::from_micros(200));
        }
        if phase == Phase::Requested {
            let gait = GaitChange { turn: Some(0.1), ..GaitChange::NONE };
            let request = Request { gait, ..Request::new(Source::Console) };
            // Its sender does not wait for the reply.
            drop(operator.requests.send(&(&request).into()));
        }
    }

    /// Kills a loop, starts it again beside the other, and ends both.
    fn loops(&mut self, victim: Victim, phase: Phase, delay: Duration) {
        let role = if victim == Victim::Controller { "controller" } else { "plant" };
        let again = Self::words(role, phase, 1);
        let (killed, other) = if phase == Phase::Starting {
            let killed = self.command_line.start_here(&Self::words(role, phase, 0));
            (killed, None)
        } else {
            let Some([controller, plant]) = self.pair(phase) else { return };
            self.reach(phase);
            if phase == Phase::Exiting {
                std::thread::sleep(Duration::from_millis(300));
            }
            match victim {
                Victim::Controller => (controller, Some(plant)),
                _ => (plant, Some(controller)),
            }
        };
        if phase == Phase::Exiting {
            killed.ask_to_end();
        }
        std::thread::sleep(delay);
        killed.kill();

        let started = self.command_line.start_here(&again);
        let mut other = match other {
            Some(other) => other,
            None => {
                let role = if victim == Victim::Controller { "plant" } else { "controller" };
                self.command_line.start_here(&Self::words(role, phase, 1))
            }
        };
        if self.wait_for_controller("after the restart").is_some() {
            self.ask("after the restart");
        }
        if !other.is_running() {
            self.aftermath.stuck.push(format!("the other process ended with {role}"));
        }
        self.end(started);
        self.end(other);
    }

    /// Kills a client; its controller goes on.
    fn clients(&mut self, victim: Victim, phase: Phase, delay: Duration) {
        let Some([controller, plant]) = self.pair(phase) else { return };
        if phase != Phase::Starting {
            self.reach(phase);
        }
        let mut killed = self.command_line.start_here(if victim == Victim::Send { "send turn 3" } else { "stream" });
        if victim == Victim::Stream {
            killed.type_on("{\"speed\":1.05}\n{\"turn_deg\":5}\n");
        }
        if phase == Phase::Exiting && victim != Victim::Send {
            std::thread::sleep(Duration::from_millis(100));
            killed.ask_to_end();
        }
        std::thread::sleep(delay);
        killed.kill();
        self.ask("after a client was killed");
        self.end(plant);
        self.end(controller);
    }

    /// Kills a walk: its children end with it.
    fn walk(&mut self, phase: Phase, delay: Duration) {
        let length = if phase == Phase::Exiting { "300ms" } else { "20s" };
        let walk = self.command_line.start_here(&format!("walk --for {length} --out walk"));
        if !matches!(phase, Phase::Starting | Phase::Exiting) {
            if self.wait_for_controller("at first").is_none() {
                return;
            }
            self.reach(if phase == Phase::Fallen || phase == Phase::Standing { Phase::Walking } else { phase });
        }
        if phase == Phase::Exiting {
            std::thread::sleep(Duration::from_millis(400));
        }
        std::thread::sleep(delay);
        walk.kill();
        let again = self.command_line.start_here("walk --lockstep --for 300ms --out again");
        let ended = again.finish();
        if ended.code != Some(0) {
            self.aftermath.stuck.push(format!("the next walk: {}", ended.stderr));
        }
    }

    /// Asks the controller for something; any answer will do.
    fn ask(&mut self, when: &str) {
        let request = Request { intent: Some(Intent::Stop), ..Request::new(Source::Console) };
        let answer = OperatorPorts::connect(self.command_line.wire_instance())
            .map_err(|error| error.to_string())
            .and_then(|operator| operator.requests.ask(&(&request).into(), SAFETY).map_err(|error| error.to_string()));
        if let Err(error) = answer {
            self.aftermath.stuck.push(format!("{when}: {error}"));
        }
    }

    fn end(&mut self, mut process: Running) {
        if process.is_running() {
            process.ask_to_end();
        } else {
            self.aftermath.stuck.push("it ended by itself".to_owned());
        }
        let ended = process.finish();
        // A fall is a failure, too; a process that a signal ended has no code.
        if ended.code.is_none() || ended.stderr.contains("panicked") || !self.aftermath.stuck.is_empty() {
            self.aftermath.stuck.push(format!("it ended badly ({:?}): {}", ended.code, ended.stderr));
        }
    }

    /// Starts and ends a controller of another instance: after that nothing of the killed ones may be left.
    fn sweep(&mut self) {
        let other = self.command_line.start("plant --instance sweeper --for 1ms");
        let socket = self.command_line.runtime_folder();
        let began = Instant::now();
        let sweeper = wire::Instance::new_in("sweeper", &socket).expect("a good name");
        while !sweeper.folder().exists() && began.elapsed() < SAFETY {
            std::thread::sleep(GLANCE);
        }
        self.end(other);
        let of_user = sweeper.folder().parent().expect("the folder of the user").to_path_buf();
        let folders = fs::read_dir(of_user).into_iter().flatten().flatten().map(|folder| folder.path());
        let shared = fs::read_dir("/dev/shm").into_iter().flatten().flatten().map(|file| file.path());
        let prefix = format!("/dev/shm/{}", self.command_line.wire_instance().prefix());
        let leaked = folders.chain(shared.filter(|path| path.display().to_string().starts_with(&prefix)));
        self.aftermath.leaked.extend(leaked.map(|path| path.display().to_string()));
    }

    fn read_recordings(&mut self) {
        let mut files = Vec::new();
        recordings_in(self.command_line.folder(), &mut files);
        for file in files {
            let name = file.display().to_string();
            // What was killed before its recording had a first byte has recorded nothing.
            if fs::metadata(&file).is_ok_and(|metadata| metadata.len() == 0) {
                continue;
            }
            match read(&file) {
                Err(error) => self.aftermath.unreadable.push(format!("{name}: {error}")),
                Ok(true) => match node::replay::replay(&file) {
                    Ok(outcome) if outcome.difference.is_none() => {}
                    Ok(outcome) => self.aftermath.wrong.push(format!("{name}: {outcome}")),
                    Err(error) => self.aftermath.unreadable.push(format!("{name}: {error}")),
                },
                Ok(false) => {}
            }
        }
    }
}

/// Reads a recording; whether it holds a setpoint.
fn read(file: &Path) -> Result<bool, record::RecordError> {
    let mut recording = Recording::open(file)?;
    let mut has_setpoint = false;
    while let Some(event) = recording.next_event()? {
        has_setpoint |= matches!(event.event, record::RunEvent::Setpoint(_));
    }
    Ok(has_setpoint)
}

fn recordings_in(folder: &Path, files: &mut Vec<std::path::PathBuf>) {
    for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            recordings_in(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "mcap") {
            files.push(path);
        }
    }
}
