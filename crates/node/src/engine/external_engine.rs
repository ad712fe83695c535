//! A process that computes the robot's physics for this one.

use interface::{Measurement, Setpoint};
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::os::unix::process::CommandExt;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

use crossbeam::channel::{Receiver, RecvTimeoutError, Sender, bounded};

use model::Joint;
use plant::{Plant, Push};
use serde::{Deserialize, Serialize};

use super::engine_error::EngineError;
use super::engine_setup::{EngineSetup, ScheduledPush, body_of};
use super::laid_floor::{FloorBody, LaidFloor};
use super::message::{PROTOCOL, SETPOINT_LEN, STATE_LEN, decode_state, encode_setpoint};

/// An engine's answer to the first message.
#[derive(Clone, Debug, Deserialize)]
struct Hello {
    protocol: u32,
    engine: String,
    setpoint: usize,
    state: usize,
    /// Names of the links that can be pushed.
    links: Vec<String>,
}

/// What has changed in the robot's world since the period before.
#[derive(Debug, Serialize)]
struct Change {
    /// The floor around the robot, if that is another one now.
    #[serde(skip_serializing_if = "Option::is_none")]
    floor: Option<Vec<FloorBody>>,
    /// Pushes that have been added.
    pushes: Vec<ScheduledPush>,
}

/// An engine in another process. It ends when dropped.
#[derive(Debug)]
pub struct ExternalEngine {
    child: Child,
    setpoints: Option<ChildStdin>,
    /// What a thread has read of the engine's output: reading by itself would wait for a hung engine without end.
    answers: Receiver<std::io::Result<Answer>>,
    floor: Option<LaidFloor>,
    /// The pushes that the engine knows.
    told_pushes: Vec<Push>,
    /// The links that it can push, by their names.
    links: Vec<String>,
    /// The engine's name as it reports it.
    pub name: String,
}

/// What an engine writes: first a line, then states.
#[derive(Debug)]
enum Answer {
    Line(String),
    State(Box<[u8; STATE_LEN * size_of::<f64>()]>),
}

/// How long an engine may take to load the robot.
const START_MAX: Duration = Duration::from_secs(120);
/// How long an engine may take to compute a control period.
const STEP_MAX: Duration = Duration::from_secs(10);

impl ExternalEngine {
    /// Starts an engine and sends it the setup.
    ///
    /// # Errors
    /// The program cannot be started, ends, or has another protocol.
    pub fn start(mut command: Command, setup: &EngineSetup) -> Result<Self, EngineError> {
        let program = command.get_program().to_string_lossy().into_owned();
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            // Ctrl-C must reach this process only, which then ends the engine.
            .process_group(0)
            .spawn()
            .map_err(|cause| EngineError::Start { program, cause })?;
        let (setpoints, states) = (child.stdin.take(), child.stdout.take().expect("a pipe was asked for"));
        let (outgoing, answers) = bounded(1);
        let mut engine = Self {
            child,
            setpoints,
            answers,
            floor: setup.laid_floor.clone(),
            told_pushes: setup.told_pushes.clone(),
            links: Vec::new(),
            name: String::new(),
        };
        std::thread::Builder::new()
            .name("engine".to_owned())
            .spawn(move || read_answers(BufReader::new(states), &outgoing))
            .map_err(EngineError::Thread)?;
        engine.send(format!("{}\n", in_json(setup)?).as_bytes())?;

        let Answer::Line(answer) = engine.answer(START_MAX)? else {
            return Err(EngineError::Mismatch("a state before the first line".to_owned()));
        };
        let hello = serde_json::from_str::<Hello>(&answer).ok();
        let fits = |hello: &Hello| (hello.protocol, hello.setpoint, hello.state) == (PROTOCOL, SETPOINT_LEN, STATE_LEN);
        let hello = hello.filter(fits).ok_or_else(|| EngineError::Mismatch(answer.trim().to_owned()))?;
        (engine.name, engine.links) = (hello.engine, hello.links);
        Ok(engine)
    }

    /// Moves the plant's robot on by one control period.
    ///
    /// # Errors
    /// The engine has ended, or its state is not finite.
    pub fn step(&mut self, plant: &mut Plant, setpoint: &Setpoint) -> Result<Measurement, EngineError> {
        let change = self.change(plant).map(|change| in_json(&change)).transpose()?.unwrap_or_default();
        self.send(&encode_setpoint(setpoint, plant.periods(), change.len()))?;
        if !change.is_empty() {
            self.send(change.as_bytes())?;
        }
        let Answer::State(state) = self.answer(STEP_MAX)? else {
            return Err(EngineError::Mismatch("a second line".to_owned()));
        };
        let state = decode_state(&state).ok_or(EngineError::NotFinite { time: plant.time() })?;
        Ok(plant.adopt(state))
    }

    /// Whether the engine's robot has a body for a link, so that it can be pushed.
    pub fn has(&self, link: Joint) -> bool {
        self.links.iter().any(|name| name == body_of(link))
    }

    /// What the engine does not know yet.
    fn change(&mut self, plant: &Plant) -> Option<Change> {
        let floor = self.floor.as_mut().and_then(|floor| floor.follow(plant));
        let pushes: Vec<Push> = plant.disturbances.pushes.iter().copied().filter(|push| self.is_news(push)).collect();
        if floor.is_none() && pushes.is_empty() {
            return None;
        }
        // Pushes that are over can be forgotten: the plant has none of them either.
        self.told_pushes.retain(|push| push.start + push.duration > plant.time());
        self.told_pushes.extend_from_slice(&pushes);
        Some(Change { floor, pushes: pushes.iter().map(ScheduledPush::from).collect() })
    }

    fn is_news(&self, push: &Push) -> bool {
        !self.told_pushes.contains(push)
    }

    fn answer(&mut self, timeout: Duration) -> Result<Answer, EngineError> {
        match self.answers.recv_timeout(timeout) {
            Ok(answer) => answer.map_err(EngineError::Ended),
            Err(RecvTimeoutError::Timeout) => Err(EngineError::Silent(timeout)),
            Err(RecvTimeoutError::Disconnected) => Err(EngineError::Ended(ErrorKind::UnexpectedEof.into())),
        }
    }

    fn send(&mut self, bytes: &[u8]) -> Result<(), EngineError> {
        let Some(pipe) = &mut self.setpoints else {
            return Err(EngineError::Ended(ErrorKind::BrokenPipe.into()));
        };
        pipe.write_all(bytes).and_then(|()| pipe.flush()).map_err(EngineError::Ended)
    }
}

fn in_json(value: &impl Serialize) -> Result<String, EngineError> {
    serde_json::to_string(value).map_err(|error| EngineError::Mismatch(error.to_string()))
}

/// Reads what an engine writes until it ends, or until nobody wants it any more.
fn read_answers(mut output: BufReader<ChildStdout>, answers: &Sender<std::io::Result<Answer>>) {
    let mut line = String::new();
    let first = match output.read_line(&mut line) {
        Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
        Ok(_) => Ok(Answer::Line(line)),
        Err(error) => Err(error),
    };
    let mut ends = first.is_err();
    ends |= answers.send(first).is_err();
    while !ends {
        let mut state = Box::new([0; STATE_LEN * size_of::<f64>()]);
        let read = output.read_exact(&mut *state).map(|()| Answer::State(state));
        ends = read.is_err();
        ends |= answers.send(read).is_err();
    }
}

impl Drop for ExternalEngine {
    fn drop(&mut self) {
        // An engine ends when its stdin does; one that does not is killed.
        drop(self.setpoints.take());
        if !matches!(self.child.try_wait(), Ok(Some(_))) {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}
