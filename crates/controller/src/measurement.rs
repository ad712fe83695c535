//! What the controller is told about the robot.

use model::{JointVector, Wrench};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// One sample of all sensors, in physical joints: 3 to 8 are the right leg's. Nothing in it is trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Counts the plant's periods.
    pub tick: u64,
    /// [rad]
    pub angles: JointVector,
    /// [rad/s]
    pub rates: JointVector,
    /// Of the ground on the right and on the left foot, about the sole's origin in sole axes.
    pub feet: [Wrench; 2],
    /// Of the trunk: maps trunk coordinates to world axes.
    pub orientation: Quaternion<f64>,
    /// Of the trunk, in its own axes [rad/s].
    pub angular_rate: Vector3<f64>,
}

impl Measurement {
    /// The vertical in trunk axes, if every value is finite and the orientation is one (to 1 %).
    pub(crate) fn up_in_trunk(&self) -> Option<Vector3<f64>> {
        let finite = self.angles.is_finite()
            && self.rates.is_finite()
            && self.feet.iter().all(Wrench::is_finite)
            && self.angular_rate.iter().all(|rate| rate.is_finite());
        let is_unit = (self.orientation.norm() - 1.0).abs() < 0.01;
        (finite && is_unit).then(|| UnitQuaternion::new_normalize(self.orientation).inverse() * Vector3::z())
    }
}
