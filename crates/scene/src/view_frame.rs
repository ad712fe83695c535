//! A frame of the page: one instant of a walk, the same of a robot that walks now and of a recording.

use interface::{AddedAngles, Capturability, DestinationProgress, Fault, Measurement, Report, WalkPose};
use model::ComState;
use nalgebra::{Isometry3, Vector2};
use serde::Serialize;

use crate::rounded::rounded;

/// One instant of a walk as the page draws it. Points are in the frame of the support foot's sole, poses in the walk
/// frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewFrame {
    /// Time since the controller started (s).
    pub t: f64,
    /// What the controller is doing, in words.
    pub mode: &'static str,
    /// The support foot: 0 right, 1 left.
    pub support: usize,
    /// Half-steps done.
    pub half_step: u64,
    /// Share of the present half-step that is done (-).
    pub progress: f64,
    /// Speed factor (-), turn, step extension and sidestep (rad) in force.
    pub gait: [f64; 4],
    /// The right sole in the walk frame: position (m), unit quaternion w x y z.
    pub base: [f64; 7],
    /// The world's origin in the walk frame: x, y (m), heading (rad), height (m); none where the floor is a plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor: Option<[f64; 4]>,
    /// Measured angles of the joints, in the paper's order (rad).
    pub angles: [f64; model::Joint::COUNT],
    /// Measured zero-moment point (m); none when the feet bear too little.
    pub zmp: Option<[f64; 2]>,
    /// That of the commanded motion (m).
    pub zmp_planned: Option<[f64; 2]>,
    /// Measured divergent component of motion (m).
    pub dcm: Option<[f64; 2]>,
    /// That of the commanded motion (m).
    pub dcm_planned: Option<[f64; 2]>,
    /// Least distance of the measured ZMP to the edge of the support polygon since the last frame (m), negative
    /// outside.
    pub margin: Option<f64>,
    /// Feedback lean over the support ankle: roll, pitch (rad).
    pub lean: [f64; 2],
    /// What the plan adds: support ankle roll and pitch, waist roll and pitch (rad).
    pub added: Option<[f64; 4]>,
    /// The middle between both soles: x, y (m), heading (rad).
    pub pose: [f64; 3],
    /// Mean velocity over the last full step, seen from the robot: ahead, left (m/s), turning (rad/s).
    pub velocity: [f64; 3],
    /// The sole of the support foot: x, y (m), heading (rad).
    pub support_sole: [f64; 3],
    /// Where the other foot and then this one are to land, likewise (m, rad).
    pub landings: [[f64; 3]; 2],
    /// Places left, distance (m) and turn (rad) of a walk to a destination.
    pub destination: Option<(u32, f64, f64)>,
    /// Measured vertical force on the right and on the left foot (N).
    pub loads: [f64; 2],
    /// What it takes to keep the robot from falling, in words; empty while no plan is followed.
    pub capturability: &'static str,
    /// Faults since the last frame, in words.
    pub faults: Vec<&'static str>,
    /// Deadlines missed since the start.
    pub missed: u64,
    /// Longest computing time of a period since the last frame (µs).
    pub compute_us: f64,
    /// Most that a period began early or late against the one before, since the last frame (µs); 0 in
    /// lockstep.
    pub jitter_us: f64,
}

/// What was seen since the last frame, beside the newest report.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SinceLastFrame {
    pub(crate) margin: Option<f64>,
    pub(crate) faults: interface::Faults,
    pub(crate) compute_ns: u64,
    pub(crate) jitter_ns: u64,
}

impl ViewFrame {
    /// The frame of a report and the newest measurement, with the pose of the right sole in the walk frame.
    pub(crate) fn new(
        t: f64,
        report: &Report,
        measurement: &Measurement,
        right_sole: &Isometry3<f64>,
        since: &SinceLastFrame,
        missed: u64,
    ) -> Self {
        let point = |point: Vector2<f64>| rounded(point.into());
        let divergent = |com: ComState| point(com.divergent_component());
        let pose = |WalkPose { x, y, heading }: &WalkPose| rounded([*x, *y, *heading]);
        let (place, turned) = (right_sole.translation, right_sole.rotation);
        let odometry = &report.odometry;
        let velocity = &odometry.velocity;
        let destination = report.destination.map(|DestinationProgress { places_left, distance, turn }| {
            let [distance, turn] = rounded([distance, turn]);
            (places_left, distance, turn)
        });
        let added = |AddedAngles { ankle, waist }: AddedAngles| rounded([ankle.x, ankle.y, waist.x, waist.y]);
        Self {
            t,
            mode: report.mode.text(),
            support: report.half_step.support.index(),
            half_step: report.half_step.index,
            progress: rounded([report.half_step.progress])[0],
            gait: rounded([report.speed, report.turn, report.extension, report.sidestep]),
            base: rounded([place.x, place.y, place.z, turned.w, turned.i, turned.j, turned.k]),
            floor: None,
            angles: rounded(measurement.angles.0),
            zmp: report.zmp_in_support.map(point),
            zmp_planned: report.zmp_planned.map(point),
            dcm: report.com_measured.map(divergent),
            dcm_planned: report.com_planned.map(divergent),
            margin: since.margin.map(|margin| rounded([margin])[0]),
            lean: point(report.lean),
            added: report.added.map(added),
            pose: pose(&odometry.pose),
            velocity: rounded([velocity.ahead, velocity.left, velocity.turn]),
            support_sole: pose(&odometry.support_sole),
            landings: [0, 1].map(|which| pose(&odometry.landings[which])),
            destination,
            loads: rounded(measurement.feet.map(|foot| foot.force.z)),
            capturability: report.capturability.map_or("", Capturability::text),
            faults: since.faults.iter().map(Fault::text).collect(),
            missed,
            compute_us: since.compute_ns as f64 / 1e3,
            jitter_us: since.jitter_ns as f64 / 1e3,
        }
    }
}
