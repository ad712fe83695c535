//! A state as a row of numbers: what the controller reports, and what is true of the simulated robot.

use controller::Tick;
use interface::Measurement;
use model::Side;
use nalgebra::{Isometry3, Vector2, Vector3};
use plant::Plant;

/// Names and widths of the columns, in their order. Units and frames are told in `tools/python/halfstep/states.py`.
pub(crate) const COLUMNS: [(&str, usize); 29] = [
    ("time", 1),
    ("mode", 1),
    ("half_step", 1),
    ("support", 1),
    ("progress", 1),
    ("speed", 1),
    ("margin", 1),
    ("zmp_in_support", 2),
    ("zmp_planned", 2),
    ("com_in_support", 3),
    ("com_velocity_in_support", 3),
    ("capturability", 1),
    ("estimated_pose", 3),
    ("estimated_velocity", 3),
    ("faults", 1),
    ("fallen", 1),
    ("right_sole", 7),
    ("left_sole", 7),
    ("loads", 2),
    ("com", 3),
    ("com_velocity", 3),
    ("zmp", 2),
    ("trunk_tilt", 1),
    ("angles", 20),
    ("rates", 20),
    ("asked_angles", 20),
    ("asked_torques", 20),
    ("measured_angles", 20),
    ("currents", 20),
];

/// Numbers in a row.
pub(crate) const WIDTH: usize = {
    let (mut width, mut place) = (0, 0);
    while place < COLUMNS.len() {
        width += COLUMNS[place].1;
        place += 1;
    }
    width
};

/// Writes the numbers of a row one after the other.
struct Writer<'r> {
    row: &'r mut [f64],
    at: usize,
}

impl Writer<'_> {
    fn put(&mut self, numbers: &[f64]) {
        self.row[self.at..self.at + numbers.len()].copy_from_slice(numbers);
        self.at += numbers.len();
    }

    /// Numbers that may be unknown: NaN each.
    fn maybe<const N: usize>(&mut self, numbers: Option<[f64; N]>) {
        self.put(&numbers.unwrap_or([f64::NAN; N]));
    }
}

/// Writes a state into a row of [`WIDTH`] numbers; what is unknown is NaN.
///
/// * `tick` – what the controller returned last; `None` before its first period
/// * `measurement` – what it will get next
pub(crate) fn write_row(row: &mut [f64], plant: &Plant, tick: Option<&Tick>, measurement: &Measurement) {
    let mut out = Writer { row, at: 0 };
    let point = |point: Vector2<f64>| [point.x, point.y];
    let vector = |vector: Vector3<f64>| [vector.x, vector.y, vector.z];
    out.put(&[plant.time()]);
    let report = tick.map(|tick| &tick.report);
    out.maybe(report.map(|report| {
        let half_step = &report.half_step;
        [
            f64::from(report.mode.code()),
            half_step.index as f64,
            f64::from(u8::from(half_step.support == Side::Left)),
            half_step.progress,
            report.speed,
        ]
    }));
    out.maybe(report.and_then(|report| report.margin).map(|margin| [margin]));
    out.maybe(report.and_then(|report| report.zmp_in_support).map(point));
    out.maybe(report.and_then(|report| report.zmp_planned).map(point));
    let com = report.and_then(|report| report.com_measured);
    out.maybe(com.map(|com| vector(com.position)));
    out.maybe(com.map(|com| vector(com.velocity)));
    out.maybe(report.and_then(|report| report.capturability).map(|verdict| [f64::from(verdict.code())]));
    out.maybe(report.map(|report| {
        let pose = report.odometry.pose;
        [pose.x, pose.y, pose.heading]
    }));
    out.maybe(report.map(|report| {
        let velocity = report.odometry.velocity;
        [velocity.ahead, velocity.left, velocity.turn]
    }));
    out.maybe(report.map(|report| [f64::from(report.faults.0)]));

    let truth = plant.truth();
    out.put(&[f64::from(u8::from(truth.has_fallen()))]);
    truth.soles.iter().for_each(|sole| out.put(&pose(sole)));
    out.put(&truth.loads);
    out.put(&vector(truth.com));
    out.put(&vector(truth.com_velocity));
    out.maybe(truth.zmp.map(point));
    out.put(&[truth.trunk_tilt]);
    out.put(&plant.robot.angles.0);
    out.put(&plant.robot.rates.0);
    out.maybe(tick.map(|tick| tick.setpoint.angles.0));
    out.maybe(tick.map(|tick| tick.setpoint.feed_forward.0));
    out.put(&measurement.angles.0);
    out.put(&measurement.currents.0);
}

/// Position and unit quaternion w, x, y, z.
fn pose(pose: &Isometry3<f64>) -> [f64; 7] {
    let (p, q) = (pose.translation, pose.rotation);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k]
}
