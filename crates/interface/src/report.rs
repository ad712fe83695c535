//! The state of the controller after a control period.

use model::{ComState, Side};
use nalgebra::{Vector2, Vector3};

use crate::{Capturability, Command, DestinationProgress, Faults, HalfStep, Mode, Odometry};

/// The state of the controller after a control period. Points, vectors and rotations are expressed in the support
/// foot's sole frame, but for the odometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// What the controller is doing.
    pub mode: Mode,
    /// The present half-step: its index, its support foot, its progress.
    pub half_step: HalfStep,
    /// `c` at this instant (-); a change of speed passes over a ramp.
    pub speed: f64,
    /// `α` in force (rad).
    pub turn: f64,
    /// `β` in force (rad).
    pub extension: f64,
    /// `γ` in force (rad).
    pub sidestep: f64,
    /// Measured ZMP (m). `None` when the feet bear too little force, and in the period of a support change, when it is
    /// known in the frame of the other foot only.
    pub zmp_in_support: Option<Vector2<f64>>,
    /// ZMP of the commanded motion (m); `None` after a fall.
    pub zmp_planned: Option<Vector2<f64>>,
    /// Signed distance of the measured ZMP to the edge of the support polygon (m), negative outside; `None` in the air.
    pub margin: Option<f64>,
    /// Feedback lean of the body over the support ankle, about x (roll) and y (pitch) (rad).
    pub lean: Vector2<f64>,
    /// What the plan adds to the plain sum of the modifications. `None` while no plan is played, and for the last knot
    /// before a support change.
    pub added: Option<AddedAngles>,
    /// Centre of mass of the commanded motion; `None` after a fall.
    pub com_planned: Option<ComState>,
    /// Measured centre of mass, levelled; `None` as for the ZMP.
    pub com_measured: Option<ComState>,
    /// What it takes to keep the robot from falling; `None` while no plan is followed.
    pub capturability: Option<Capturability>,
    /// What is estimated beside ZMP, centre of mass and place.
    pub estimate: StateEstimate,
    /// Where the robot is, as estimated.
    pub odometry: Odometry,
    /// How far the walk to a destination has come; `None` if there is none, or another request took its place.
    pub destination: Option<DestinationProgress>,
    /// What is wrong.
    pub faults: Faults,
}

impl Report {
    /// The report of a mode with nothing measured, planned or wrong and the nominal gait in force, at the beginning of
    /// the walk frame: for whoever poses as a controller, and as a start for other reports.
    pub fn of(mode: Mode) -> Self {
        let Command { turn, speed, extension, sidestep } = Command::NOMINAL;
        Self {
            mode,
            half_step: HalfStep::first(Side::Right),
            speed,
            turn,
            extension,
            sidestep,
            zmp_in_support: None,
            zmp_planned: None,
            margin: None,
            lean: Vector2::zeros(),
            added: None,
            com_planned: None,
            com_measured: None,
            capturability: None,
            estimate: StateEstimate::default(),
            odometry: Odometry::default(),
            destination: None,
            faults: Faults::default(),
        }
    }
}

/// What is estimated of the robot and its surroundings beside ZMP, centre of mass and place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StateEstimate {
    /// Whether the right and the left foot touch the ground.
    pub contact: [bool; 2],
    /// Horizontal force by which something pushes or pulls the robot (N).
    pub external_force: Vector2<f64>,
    /// By how much the centre of mass seems to be farther ahead and to the left than it is (m): by a payload, wrong
    /// masses, or an inertial measurement unit that is askew.
    pub com_offset: Vector2<f64>,
    /// Bias of the gyro about the axes of the trunk (rad/s).
    pub gyro_bias: Vector3<f64>,
}

/// Rotations that the plan adds to the plain sum of the modifications, about x (roll) and y (pitch) (rad).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AddedAngles {
    /// Rotation of the whole body over the support ankle.
    pub ankle: Vector2<f64>,
    /// Rotation of the trunk over the pelvis.
    pub waist: Vector2<f64>,
}
