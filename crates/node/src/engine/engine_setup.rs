//! The first message to an engine: the robot as its mechanism or as its URDF, and what the run begins with.

use interchange::mjcf::mjcf_text_on;
use model::{Joint, Mechanism, UrdfSource};
use plant::{Disturbances, PlantParameters, Push, RobotState, with_mass_error};
use serde::Serialize;

use super::engine_error::EngineError;
use super::laid_floor::{EDGE_MIN, FloorBody, LaidFloor};
use super::message::PROTOCOL;
use super::urdf_setup::UrdfSetup;

/// The first message to an engine: robot, floor, drives, and disturbances.
#[derive(Clone, Debug, Serialize)]
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
    /// Bodies of the floor around the robot; none if it is a plane.
    floor: Vec<FloorBody>,
    /// The pushes above.
    #[serde(skip)]
    pub(super) told_pushes: Vec<Push>,
    #[serde(skip)]
    pub(super) laid_floor: Option<LaidFloor>,
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
pub(super) struct ScheduledPush {
    body: &'static str,
    impulse: [f64; 3],
    start: f64,
    duration: f64,
}

impl InitialState {
    fn of(start: &RobotState) -> Self {
        let orientation = start.sole_to_world.rotation;
        Self {
            position: start.sole_to_world.translation.vector.into(),
            orientation: [orientation.w, orientation.i, orientation.j, orientation.k],
            angular_rate: start.angular_rate.into(),
            velocity: start.velocity.into(),
            angles: start.angles.0,
            rates: start.rates.0,
        }
    }
}

impl From<&Push> for ScheduledPush {
    fn from(push: &Push) -> Self {
        let Push { link, impulse, start, duration } = *push;
        Self { body: body_of(link), impulse: impulse.into(), start, duration }
    }
}

/// The name by which an engine knows a link.
pub(super) fn body_of(link: Joint) -> &'static str {
    link.link_name().unwrap_or(link.name())
}

impl EngineSetup {
    /// The setup for the robot that the plant's parameters and seed define, with its initial state.
    ///
    /// # Errors
    /// [`EngineError::FineFloor`].
    pub fn new(
        mechanism: &Mechanism,
        parameters: &PlantParameters,
        disturbances: &Disturbances,
        start: &RobotState,
        seed: u64,
        period: f64,
    ) -> Result<Self, EngineError> {
        let ground = parameters.ground(seed);
        if let Some(edge) = ground.finest_edge().filter(|edge| *edge < EDGE_MIN) {
            return Err(EngineError::FineFloor { edge });
        }
        let laid_floor = LaidFloor::around(ground, start.sole_to_world.translation.vector.xy());
        // The engine gets its bodies by themselves, since they change.
        let without_bodies = laid_floor.as_ref().map(|_| [].as_slice());
        let built = with_mass_error(mechanism, parameters.mass_error, seed);
        let servo = |joint| parameters.servo.of(mechanism.servos.of(joint));
        let motors = || Joint::ALL.into_iter().filter_map(|joint| Some((joint, mechanism.links[joint].motor?)));
        Ok(Self {
            protocol: PROTOCOL,
            robot: RobotModel::Mechanism { mjcf: mjcf_text_on(&built, parameters, without_bodies, period) },
            period_s: period,
            steps_per_period: parameters.steps_per_period,
            joints: motors().map(|(joint, _)| joint.name()).collect(),
            stiffness: motors().map(|(joint, _)| servo(joint).stiffness).collect(),
            damping: motors().map(|(joint, _)| servo(joint).damping).collect(),
            back_emf: motors().map(|(_, motor)| motor.back_emf_damping()).collect(),
            start: InitialState::of(start),
            pushes: disturbances.pushes.iter().map(ScheduledPush::from).collect(),
            told_pushes: disturbances.pushes.clone(),
            floor: laid_floor.as_ref().map(LaidFloor::bodies).unwrap_or_default(),
            laid_floor,
        })
    }

    /// The same robot that begins in another state.
    #[must_use]
    pub(super) fn beginning(self, start: &RobotState) -> Self {
        Self { start: InitialState::of(start), ..self }
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
