//! The process that computes the robot's physics for this one.

use std::io::{BufRead, BufReader, Read, Write};
use std::os::unix::process::CommandExt;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use model::{Joint, Mechanism};
use plant::{Disturbances, Measurement, Parameters, Plant, RobotState, Setpoint, with_mass_error};
use serde::{Deserialize, Serialize};

use super::record::{self, SETPOINT, STATE};
use crate::mjcf::mjcf_text;

/// The version of what is said to engines.
const PROTOCOL: u32 = 1;

/// What an engine is told before it begins.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Setup {
    protocol: u32,
    /// Robot and floor, complete.
    mjcf: String,
    period_s: f64,
    steps_per_period: u32,
    /// The powered joints in the order of all records.
    joints: Vec<&'static str>,
    /// Of each powered joint's servo [N·m/rad].
    stiffness: Vec<f64>,
    /// Likewise [N·m·s/rad].
    damping: Vec<f64>,
    /// Torque lost to back-EMF per rate [N·m·s/rad].
    back_emf: Vec<f64>,
    start: Start,
    pushes: Vec<Push>,
}

/// How the robot is at first; all but the joints' in world axes.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Start {
    position: [f64; 3],
    /// w x y z
    orientation: [f64; 4],
    angular_rate: [f64; 3],
    velocity: [f64; 3],
    angles: [f64; Joint::COUNT],
    rates: [f64; Joint::COUNT],
}

/// A force on a link's centre of mass.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Push {
    body: &'static str,
    impulse: [f64; 3],
    start: f64,
    duration: f64,
}

/// What an engine answers.
#[derive(Clone, Debug, Deserialize)]
struct Hello {
    protocol: u32,
    engine: String,
    setpoint: usize,
    state: usize,
}

/// An engine in another process. It ends when dropped.
#[derive(Debug)]
pub struct OutsideEngine {
    child: Child,
    setpoints: Option<ChildStdin>,
    states: BufReader<ChildStdout>,
    /// What it calls itself.
    pub name: String,
}

/// Why an engine does not do its work. What it printed on stderr has told the person more.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// The program cannot be started.
    #[error("cannot start the engine `{program}`: {cause}")]
    Start {
        /// Which program.
        program: String,
        /// What the system says.
        cause: std::io::Error,
    },
    /// It knows even floors only.
    #[error("unevenness.height_m is {height}: other engines know even floors only, 0 would be right")]
    Uneven {
        /// What was asked for [m].
        height: f64,
    },
    /// It went away.
    #[error("the engine has ended: {0}")]
    Ended(std::io::Error),
    /// It does not speak as it should.
    #[error(
        "the engine speaks otherwise: expected protocol {PROTOCOL} with records of {SETPOINT} and {STATE} numbers, got {0}"
    )]
    Mismatch(String),
    /// It does not simulate any more.
    #[error("the engine's state after {time} s is not finite, or its orientation is none")]
    NotFinite {
        /// Since the start [s].
        time: f64,
    },
}

impl Setup {
    /// The robot as the plant's parameters and seed make it, in the state in which it begins.
    ///
    /// # Errors
    /// [`EngineError::Uneven`].
    pub fn new(
        mechanism: &Mechanism,
        parameters: &Parameters,
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
            mjcf: mjcf_text(&built, parameters, period),
            period_s: period,
            steps_per_period: parameters.steps_per_period,
            joints: motors().map(|(joint, _)| joint.name()).collect(),
            stiffness: motors().map(|(joint, _)| parameters.servo[joint].stiffness).collect(),
            damping: motors().map(|(joint, _)| parameters.servo[joint].damping).collect(),
            back_emf: motors().map(|(_, motor)| motor.back_emf_damping()).collect(),
            start: Start {
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
                .map(|push| Push {
                    body: push.link.link_name().unwrap_or(push.link.name()),
                    impulse: push.impulse.into(),
                    start: push.start,
                    duration: push.duration,
                })
                .collect(),
        })
    }
}

impl OutsideEngine {
    /// Starts a program and tells it the robot.
    ///
    /// # Errors
    /// It cannot be started, ends, or speaks otherwise.
    pub fn start(mut command: Command, setup: &Setup) -> Result<Self, EngineError> {
        let program = command.get_program().to_string_lossy().into_owned();
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            // Ctrl-C is for this process, which ends the other in order.
            .process_group(0)
            .spawn()
            .map_err(|cause| EngineError::Start { program, cause })?;
        let (setpoints, states) = (child.stdin.take(), child.stdout.take().expect("a pipe was asked for"));
        let mut engine = Self { child, setpoints, states: BufReader::new(states), name: String::new() };
        let told = serde_json::to_string(setup).map_err(|error| EngineError::Mismatch(error.to_string()))?;
        engine.send(format!("{told}\n").as_bytes())?;

        let mut answer = String::new();
        engine.states.read_line(&mut answer).map_err(EngineError::Ended)?;
        if answer.is_empty() {
            return Err(EngineError::Ended(std::io::ErrorKind::UnexpectedEof.into()));
        }
        let hello = serde_json::from_str::<Hello>(&answer).ok();
        let fits = |hello: &Hello| (hello.protocol, hello.setpoint, hello.state) == (PROTOCOL, SETPOINT, STATE);
        let hello = hello.filter(fits).ok_or_else(|| EngineError::Mismatch(answer.trim().to_owned()))?;
        engine.name = hello.engine;
        Ok(engine)
    }

    /// Moves the plant's robot on by one control period.
    ///
    /// # Errors
    /// It has ended, or what it computes is not finite.
    pub fn step(&mut self, plant: &mut Plant, setpoint: &Setpoint) -> Result<Measurement, EngineError> {
        self.send(&record::setpoint(setpoint))?;
        let mut state = [0; STATE * size_of::<f64>()];
        self.states.read_exact(&mut state).map_err(EngineError::Ended)?;
        let outcome = record::outcome(&state).ok_or(EngineError::NotFinite { time: plant.time() })?;
        Ok(plant.adopt(outcome))
    }

    fn send(&mut self, bytes: &[u8]) -> Result<(), EngineError> {
        let Some(pipe) = &mut self.setpoints else {
            return Err(EngineError::Ended(std::io::ErrorKind::BrokenPipe.into()));
        };
        pipe.write_all(bytes).and_then(|()| pipe.flush()).map_err(EngineError::Ended)
    }
}

impl Drop for OutsideEngine {
    fn drop(&mut self) {
        // Its stdin ends, and so does it; if not, nothing more can be done than to end it.
        drop(self.setpoints.take());
        if !matches!(self.child.try_wait(), Ok(Some(_))) {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}
