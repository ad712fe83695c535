//! Bounds of the consistency check.

/// Bounds of the consistency check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConsistencyParameters {
    /// Largest angle between the measured vertical and the one predicted by the gyro (rad).
    pub orientation_error_max: f64,
    /// Largest difference of a measured joint angle from its setpoint (rad).
    pub tracking_error_max: f64,
    /// Largest mean of this difference over 0.3 s (rad).
    pub tracking_bias_max: f64,
    /// Largest difference of a measured joint angle from the integral of its measured rate (rad).
    pub rate_error_max: f64,
    /// Least and largest mean of the force on both feet over 0.1 s of a walk, as shares of the weight (-).
    pub load_share: [f64; 2],
}
