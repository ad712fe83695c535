//! One sample of all sensors.

use model::{JointVector, Wrench};
use nalgebra::{Quaternion, Vector3};

use crate::SensorGroups;

/// One sample of all sensors, by physical joint and foot. Nothing in it is trusted: the controller validates it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Which sample it is, counted in the plant's control periods: the same number again is the same sample again.
    pub sample: u64,
    /// Joint angles (rad); joints 1 and 2 hold the tilt of the support sole.
    pub angles: JointVector,
    /// Joint rates (rad/s); those of joints 1 and 2 are not measured and 0.
    pub rates: JointVector,
    /// Wrench of the ground on the right and on the left foot (N, N·m), about the sole's origin in sole axes.
    pub feet: [Wrench; 2],
    /// Orientation of the trunk: maps trunk coordinates to level axes, whose z is the true vertical.
    pub orientation: Quaternion<f64>,
    /// Angular rate of the trunk, in trunk axes (rad/s).
    pub angular_rate: Vector3<f64>,
    /// Acceleration of the trunk's origin less gravity, in trunk axes (m/s²): upwards by `g` at rest.
    pub specific_force: Vector3<f64>,
    /// Motor currents (A); 0 for joints 1 and 2.
    pub currents: JointVector,
    /// The groups whose values are missing in this sample; what stands in their place means nothing.
    pub missing: SensorGroups,
}
