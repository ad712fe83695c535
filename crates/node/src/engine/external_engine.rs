//! A process that computes the robot's physics for this one.

use interface::{Measurement, Setpoint};
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::os::unix::process::CommandExt;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

use crossbeam::channel::{Receiver, RecvTimeoutError, Sender, bounded};

use interchange::mjcf::mjcf_text;
use model::{Joint, Mechanism, UrdfSource};
use plant::{Disturbances, Plant, PlantParameters, RobotState, with_mass_error};
use serde::{Deserialize, Serialize};

use super::message::{SETPOINT_LEN, STATE_LEN, decode_state, encode_setpoint};
use super::urdf_setup::UrdfSetup;

/// Version of the protocol between this program and engines.
const PROTOCOL: u32 = 1;

/// The first message to an engine: robot, floor, drives, and disturbances.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EngineSetup {
    protocol: u32,
    #[serde(flatten)]
    robot: RobotModel,
    period_s: f64,
    steps_per_period: u32,
    /// Names of the powered joints, in the order of the other lists.
    joints: Vec<&'static str>,
    /// Servo stiffness of each powered joint (N·m/rad).
    stiffness: Vec<f64>,
    /// Servo damping of each powered joint (N·m·s/rad).
    damping: Vec<f64>,
    /// Torque lost to back-EMF of each powered joint, per rate (N·m·s/rad).
    back_emf: Vec<f64>,
    start: InitialState,
    pushes: Vec<ScheduledPush>,
}

/// How the robot is described; the variant's fields are keys of the message.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum RobotModel {
    /// Mechanism and floor as a complete MJCF model.
    Mechanism { mjcf: String },
    /// The URDF that the mechanism was imported from.
    Urdf { urdf: String, urdf_setup: Box<UrdfSetup> },
}

/// State of the robot at the start; angles and rates are the joints', the rest are the right sole's in world axes.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct InitialState {
    position: [f64; 3],
    /// Unit quaternion w, x, y, z.
    orientation: [f64; 4],
    angular_rate: [f64; 3],
    velocity: [f64; 3],
    angles: [f64; Joint::COUNT],
    rates: [f64; Joint::COUNT],
}

/// A push at a link's centre of mass.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct ScheduledPush {
    body: &'static str,
    impulse: [f64; 3],
    start: f64,
    duration: f64,
}

/// An engine's answer to the first message.
#[derive(Clone, Debug, Deserialize)]
struct Hello {
    protocol: u32,
    engine: String,
    setpoint: usize,
    state: usize,
}

/// An engine in another process. It ends when dropped.
#[derive(Debug)]
pub struct ExternalEngine {
    child: Child,
    setpoints: Option<ChildStdin>,
    /// What a thread has read of the engine's output: reading by itself would wait for a hung engine without end.
    answers: Receiver<std::io::Result<Answer>>,
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

/// Why an engine cannot be used. The engine itself may have printed more on stderr.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// The engine's program cannot be started.
    #[error("cannot start the engine `{program}`: {cause}")]
    Start {
        /// Name of the program.
        program: String,
        /// Why the operating system refused.
        cause: std::io::Error,
    },
    /// The plant's parameters have an uneven floor, which external engines do not support.
    #[error("unevenness.height_m is {height}: other engines know even floors only, 0 would be right")]
    Uneven {
        /// The configured height of the unevenness (m).
        height: f64,
    },
    /// The engine's process has ended.
    #[error("the engine has ended: {0}")]
    Ended(std::io::Error),
    /// The engine runs but does not answer.
    #[error("the engine has not answered for {} s", .0.as_secs())]
    Silent(Duration),
    /// The operating system refused a thread to read from the engine.
    #[error("cannot start a thread: {0}")]
    Thread(std::io::Error),
    /// The engine's protocol is a different one.
    #[error(
        "engine protocol mismatch: expected protocol {PROTOCOL} with records of {SETPOINT_LEN} and {STATE_LEN} \
         numbers, got {0}"
    )]
    Mismatch(String),
    /// The engine's simulation has diverged.
    #[error("the engine's state after {time} s is not finite, or its orientation is invalid")]
    NotFinite {
        /// Simulated time since the start (s).
        time: f64,
    },
}

impl EngineSetup {
    /// The setup for the robot that the plant's parameters and seed define, with its initial state.
    ///
    /// # Errors
    /// [`EngineError::Uneven`].
    pub fn new(
        mechanism: &Mechanism,
        parameters: &PlantParameters,
        disturbances: &Disturbances,
        start: &RobotState,
        seed: u64,
        period: f64,
    ) -> Result<Self, EngineError> {
        if parameters.unevenness.height > 0.0 {
            return Err(EngineError::Uneven { height: parameters.unevenness.height });
        }
        let built = with_mass_error(mechanism, parameters.mass_error, seed);
        let motors = || Joint::ALL.into_iter().filter_map(|joint| Some((joint, mechanism.links[joint].motor?)));
        let orientation = start.sole_to_world.rotation;
        Ok(Self {
            protocol: PROTOCOL,
            robot: RobotModel::Mechanism { mjcf: mjcf_text(&built, parameters, period) },
            period_s: period,
            steps_per_period: parameters.steps_per_period,
            joints: motors().map(|(joint, _)| joint.name()).collect(),
            stiffness: motors().map(|(joint, _)| parameters.servo[joint].stiffness).collect(),
            damping: motors().map(|(joint, _)| parameters.servo[joint].damping).collect(),
            back_emf: motors().map(|(_, motor)| motor.back_emf_damping()).collect(),
            start: InitialState {
                position: start.sole_to_world.translation.vector.into(),
                orientation: [orientation.w, orientation.i, orientation.j, orientation.k],
                angular_rate: start.angular_rate.into(),
                velocity: start.velocity.into(),
                angles: start.angles.0,
                rates: start.rates.0,
            },
            pushes: disturbances
                .pushes
                .iter()
                .map(|push| ScheduledPush {
                    body: push.link.link_name().unwrap_or(push.link.name()),
                    impulse: push.impulse.into(),
                    start: push.start,
                    duration: push.duration,
                })
                .collect(),
        })
    }

    /// The same run with the robot that the text of a URDF describes, from which the mechanism was imported.
    #[must_use]
    pub fn with_urdf(
        self,
        urdf: String,
        source: &UrdfSource,
        mechanism: &Mechanism,
        parameters: &PlantParameters,
        seed: u64,
    ) -> Self {
        let urdf_setup = Box::new(UrdfSetup::new(mechanism, source, parameters, seed));
        Self { robot: RobotModel::Urdf { urdf, urdf_setup }, ..self }
    }
}

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
        let mut engine = Self { child, setpoints, answers, name: String::new() };
        std::thread::Builder::new()
            .name("engine".to_owned())
            .spawn(move || read_answers(BufReader::new(states), &outgoing))
            .map_err(EngineError::Thread)?;
        let line = serde_json::to_string(setup).map_err(|error| EngineError::Mismatch(error.to_string()))?;
        engine.send(format!("{line}\n").as_bytes())?;

        let Answer::Line(answer) = engine.answer(START_MAX)? else {
            return Err(EngineError::Mismatch("a state before the first line".to_owned()));
        };
        let hello = serde_json::from_str::<Hello>(&answer).ok();
        let fits = |hello: &Hello| (hello.protocol, hello.setpoint, hello.state) == (PROTOCOL, SETPOINT_LEN, STATE_LEN);
        let hello = hello.filter(fits).ok_or_else(|| EngineError::Mismatch(answer.trim().to_owned()))?;
        engine.name = hello.engine;
        Ok(engine)
    }

    /// Moves the plant's robot on by one control period.
    ///
    /// # Errors
    /// The engine has ended, or its state is not finite.
    pub fn step(&mut self, plant: &mut Plant, setpoint: &Setpoint) -> Result<Measurement, EngineError> {
        self.send(&encode_setpoint(setpoint))?;
        let Answer::State(state) = self.answer(STEP_MAX)? else {
            return Err(EngineError::Mismatch("a second line".to_owned()));
        };
        let state = decode_state(&state).ok_or(EngineError::NotFinite { time: plant.time() })?;
        Ok(plant.adopt(state))
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
