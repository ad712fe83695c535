//! Thresholds of the measurement validator.

use crate::sensor_consistency::ConsistencyParameters;

/// What counts as a valid measurement and as a fall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValidatorParameters {
    /// Longest time without a valid measurement (s); beyond it the robot stops.
    pub timeout: f64,
    /// Tilt of the trunk beyond which the robot cannot recover (rad).
    pub tilt_max: f64,
    /// Time that the trunk must be tilted beyond recovery before the robot counts as fallen (s). No fall ends sooner.
    pub fall_confirmation: f64,
    /// Tolerance of the measured joint angles beyond their range (rad): stops give way, encoders are mounted by hand.
    pub angle_tolerance: f64,
    /// Largest measured joint rate, as a multiple of the joint's rate limit (-).
    pub rate_factor_max: f64,
    /// Largest measured angular rate of the trunk about an axis (rad/s).
    pub trunk_rate_max: f64,
    /// Largest measured force on a foot, as a multiple of the robot's weight (-); likewise for moments, at an arm of 1
    /// m.
    pub load_factor_max: f64,
    /// Largest angle between the measured vertical and the one that the gyro predicts from the last sample (rad).
    pub orientation_jump_max: f64,
    /// Largest change of the trunk's angular rate between two samples (rad/s): no push turns a trunk more suddenly.
    pub trunk_rate_jump_max: f64,
    /// Longest gap between two samples that the gyro can bridge (s).
    pub gyro_horizon: f64,
    /// How far measurements may contradict each other and the setpoint.
    pub consistency: ConsistencyParameters,
}

impl ValidatorParameters {
    /// Thresholds for a `timeout` (s) and a `tilt_max` (rad) where the configuration has no others.
    pub const fn with_default_thresholds(timeout: f64, tilt_max: f64) -> Self {
        Self {
            timeout,
            tilt_max,
            fall_confirmation: 0.05,
            angle_tolerance: 0.5,
            rate_factor_max: 5.0,
            trunk_rate_max: 50.0,
            load_factor_max: 50.0,
            orientation_jump_max: 0.175,
            trunk_rate_jump_max: 5.0,
            gyro_horizon: 0.25,
            consistency: ConsistencyParameters {
                orientation_error_max: 0.012,
                tracking_error_max: 0.15,
                tracking_bias_max: 0.02,
                rate_error_max: 0.01,
                load_share: [0.6, 1.5],
            },
        }
    }
}
