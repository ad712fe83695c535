//! Rows of the log: the plant and the controller at one tick.

use interface::{AddedAngles, DestinationProgress, Mode, WalkPose};
use model::{ComState, Joint, JointVector, Side};
use nalgebra::{Isometry3, Vector2, Vector3};
use serde::Serialize;

use super::columns;

/// A foot with a smaller share of the other foot's load counts as unloaded.
const UNLOADED_SHARE: f64 = 0.02;

/// A line of one of the log's CSV files.
pub trait CsvRow: Serialize {
    /// Name of the CSV file.
    const FILE: &str;

    /// Names of the columns in the order of the fields; a vector has one column per component.
    fn columns() -> Vec<String>;
}

/// The true state of the simulated robot at one tick.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlantRow {
    /// Time since the start of the run (s).
    pub time: f64,
    /// Number of the tick since the start.
    pub tick: u64,
    /// Pose of the right sole: maps sole coordinates to world coordinates.
    #[serde(serialize_with = "columns::pose")]
    pub right_sole_to_world: Isometry3<f64>,
    /// Angles of the physical joints (rad).
    #[serde(serialize_with = "columns::joints")]
    pub angles: JointVector,
    /// Vertical force of the ground on the right and on the left foot (N).
    pub loads: [f64; 2],
    /// Centre of mass in world coordinates (m).
    #[serde(serialize_with = "columns::vector")]
    pub com_in_world: Vector3<f64>,
    /// Its velocity (m/s), where it is estimated; true states have none.
    #[serde(skip)]
    pub com_velocity: Option<Vector3<f64>>,
    /// Zero-moment point of both feet in world coordinates (m); `None` in the air.
    #[serde(serialize_with = "columns::maybe_point")]
    pub zmp_in_world: Option<Vector2<f64>>,
    /// Angle between trunk and vertical (rad).
    pub trunk_tilt: f64,
    /// Whether the robot has fallen.
    #[serde(serialize_with = "columns::flag")]
    pub fallen: bool,
}

/// The report of the controller at one tick.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ControllerRow {
    /// Time since the start of the run (s).
    pub time: f64,
    /// Number of the tick since the start.
    pub tick: u64,
    /// Name of the mode, as in `walking`.
    pub mode: &'static str,
    /// The support foot.
    pub support: Side,
    /// Half-steps completed before the present one.
    pub half_step: u64,
    /// `s`: progress of the present half-step, 0 to 1.
    pub progress: f64,
    /// Speed factor `c` at this instant, on its ramp to the one in force.
    pub speed: f64,
    /// Turn angle `α` in force (rad); in degrees in the file.
    #[serde(serialize_with = "columns::degrees")]
    pub turn_command: f64,
    /// Speed factor `c` in force.
    pub speed_command: f64,
    /// Step extension `β` in force (rad); in degrees in the file.
    #[serde(serialize_with = "columns::degrees")]
    pub extension_command: f64,
    /// Sidestep `γ` in force (rad); in degrees in the file.
    #[serde(serialize_with = "columns::degrees")]
    pub sidestep_command: f64,
    /// Measured ZMP in support coordinates (m); `None` if the feet carry too little.
    #[serde(serialize_with = "columns::maybe_point")]
    pub zmp_measured: Option<Vector2<f64>>,
    /// Planned ZMP in support coordinates (m); `None` without a plan.
    #[serde(serialize_with = "columns::maybe_point")]
    pub zmp_planned: Option<Vector2<f64>>,
    /// Signed distance of the measured ZMP from the edge of the support polygon (m), negative outside; `None` in the
    /// air.
    pub margin: Option<f64>,
    /// Feedback at the support ankle about x (rad); in degrees in the file.
    #[serde(serialize_with = "columns::degrees")]
    pub lean_roll: f64,
    /// Feedback at the support ankle about y (rad); in degrees in the file.
    #[serde(serialize_with = "columns::degrees")]
    pub lean_pitch: f64,
    /// Angles that the plan adds to the sum of the modifications (rad), in degrees in the file; `None` if unknown.
    #[serde(serialize_with = "columns::added_angles")]
    pub added: Option<AddedAngles>,
    /// Planned centre of mass in support coordinates; `None` without a plan.
    #[serde(serialize_with = "columns::centre_of_mass")]
    pub com_planned: Option<ComState>,
    /// Estimated centre of mass, likewise; `None` if the feet carry too little, and in the tick of a support change.
    #[serde(serialize_with = "columns::centre_of_mass")]
    pub com_measured: Option<ComState>,
    /// The middle between both soles in the walk frame, as the controller estimates it (m, rad).
    #[serde(serialize_with = "columns::walk_pose")]
    pub walk_pose: WalkPose,
    /// How far the walk to a destination has come (m, rad; in degrees in the file); `None` without one.
    #[serde(serialize_with = "columns::destination")]
    pub destination: Option<DestinationProgress>,
    /// One bit for each fault present.
    pub faults: u32,
    /// Computing time of the tick (ns).
    pub compute_ns: u64,
    /// Deadlines missed since the start.
    pub missed: u64,
}

impl ControllerRow {
    /// Whether the planned zero-moment point is in the support sole: near a support change it moves from foot to foot.
    pub fn is_off_support_changes(&self) -> bool {
        (0.05..0.95).contains(&self.progress)
    }

    /// Whether the controller balances the robot: it has not fallen, and no fault has stopped it.
    pub fn is_balancing(&self) -> bool {
        ![Mode::Fallen, Mode::Faulted].map(Mode::text).contains(&self.mode)
    }
}

impl PlantRow {
    /// Whether the foot on `side` carries the robot and the other one is unloaded.
    pub fn bears_alone(&self, side: Side) -> bool {
        let other = self.loads[side.other().index()];
        self.bears(side) && other < UNLOADED_SHARE * self.loads[side.index()]
    }
}

impl CsvRow for PlantRow {
    const FILE: &str = "plant.csv";

    fn columns() -> Vec<String> {
        let before = ["t_s", "tick", "right_sole_x_m", "right_sole_y_m", "right_sole_z_m"];
        let rotation = ["right_sole_qw", "right_sole_qx", "right_sole_qy", "right_sole_qz"];
        let joints = Joint::ALL.map(|joint| format!("joint_{:02}_angle_rad", joint.number()));
        let after = ["load_right_n", "load_left_n", "com_x_m", "com_y_m", "com_z_m", "zmp_x_m", "zmp_y_m"];
        let state = ["trunk_tilt_rad", "fallen"];
        let (head, tail) = (before.into_iter().chain(rotation), after.into_iter().chain(state));
        head.map(String::from).chain(joints).chain(tail.map(String::from)).collect()
    }
}

impl CsvRow for ControllerRow {
    const FILE: &str = "controller.csv";

    fn columns() -> Vec<String> {
        let place = ["t_s", "tick", "mode", "support", "half_step", "progress"];
        let command = ["speed", "turn_command_deg", "speed_command", "extension_command_deg", "sidestep_command_deg"];
        let balance = ["zmp_measured_x_m", "zmp_measured_y_m", "zmp_planned_x_m", "zmp_planned_y_m", "margin_m"];
        let lean = ["lean_roll_deg", "lean_pitch_deg"];
        let added =
            ["ankle_roll", "ankle_pitch", "waist_roll", "waist_pitch"].map(|angle| format!("added_{angle}_deg"));
        let com = ["planned", "measured"].into_iter().flat_map(|which| {
            ["x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s"].map(|component| format!("com_{which}_{component}"))
        });
        let walk = ["walk_x_m", "walk_y_m", "walk_heading_rad"];
        let goal = ["destination_places_left", "destination_distance_m", "destination_turn_deg"];
        let health = ["faults", "compute_ns", "missed"];
        let after = walk.into_iter().chain(goal).chain(health).map(String::from);
        let before = place.into_iter().chain(command).chain(balance).chain(lean).map(String::from);
        before.chain(added).chain(com).chain(after).collect()
    }
}
