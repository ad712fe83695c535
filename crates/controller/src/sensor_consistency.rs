//! Consistency of the sensors with each other and with what was commanded: finds sensors whose values are plausible one
//! by one and yet wrong.
//!
//! * **Frozen**: a noisy sensor never repeats its value to the bit. While joints move, a group of values that changed
//!   with every sample before and stays the same over [`FROZEN_MAX`] is frozen, and so is the angle of a joint that is
//!   commanded to move. At rest nothing is suspected: nothing is lost by it.
//! * **Orientation against gyro**: the vertical that the gyro predicts, corrected slowly by the measured one, must stay
//!   close to the measured one. This finds steps and drifts of the orientation, and bias, sign and scale of the gyro.
//! * **Joint angle against setpoint**: the drives follow within a bound, so that an encoder that is off, stuck or
//!   reversed is found, and so is a joint that does not follow.
//!
//! A sample that contradicts is rejected at once: for a while the plan goes on without it, which costs less than
//! feedback of a wrong value. Only if that lasts does the robot stop.

use interface::{Measurement, Setpoint};
use model::{Joint, JointVector, PerJoint};
use nalgebra::Vector3;

/// Longest time for which values may stay the same while the robot moves (s).
const FROZEN_MAX: f64 = 0.02;
/// Samples in a row that must differ before a group is known to change with every sample.
const NOISY_AFTER: u32 = 100;
/// Commanded rate above which a joint moves (rad/s).
const MOVING: f64 = 0.2;
/// Force above which a foot is loaded, so that its force changes (N).
const LOADED: f64 = 50.0;
/// Time constant with which the predicted vertical is corrected by the measured one (s).
const CORRECTION_TIME_CONSTANT: f64 = 0.2;

/// Bounds of the consistency check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConsistencyParameters {
    /// Largest angle between the measured vertical and the one predicted by the gyro (rad).
    pub orientation_error_max: f64,
    /// Largest difference of a measured joint angle from its setpoint (rad).
    pub tracking_error_max: f64,
}

/// What contradicts itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Inconsistency {
    /// A group of values stays the same although the robot moves.
    Frozen,
    /// Orientation and angular rate of the trunk contradict each other.
    Orientation,
    /// A joint is not where it was commanded to be.
    Tracking,
}

/// Checks measurements against each other and against setpoints.
#[derive(Clone, Debug)]
pub(crate) struct SensorConsistency {
    parameters: ConsistencyParameters,
    last: Option<Measurement>,
    /// How long each joint's angle has stayed the same while it moves (s).
    frozen_joints: PerJoint<f64>,
    /// How long joint rates, right foot, left foot, orientation and angular rate have stayed the same (s).
    frozen: [f64; 5],
    /// How many samples in a row these groups have changed.
    changed: [u32; 5],
    /// Which of them are known to change with every sample.
    is_noisy: [bool; 5],
    /// The vertical in trunk axes that the gyro predicts.
    vertical: Option<Vector3<f64>>,
}

impl SensorConsistency {
    /// A check that has seen no measurement.
    pub(crate) fn new(parameters: ConsistencyParameters) -> Self {
        Self {
            parameters,
            last: None,
            frozen_joints: PerJoint::from_fn(|_| 0.0),
            frozen: [0.0; 5],
            changed: [0; 5],
            is_noisy: [false; 5],
            vertical: None,
        }
    }

    /// Checks a new sample, and returns what contradicts itself.
    ///
    /// * `vertical` – measured, in trunk axes (unit vector)
    /// * `setpoint` – the last one
    /// * `dt` – time since the sample before (s)
    pub(crate) fn update(
        &mut self,
        measurement: &Measurement,
        vertical: &Vector3<f64>,
        setpoint: &Setpoint,
        dt: f64,
    ) -> Option<Inconsistency> {
        let is_frozen = self.is_frozen(measurement, &setpoint.rates, dt);
        let is_turned = self.contradicts_gyro(measurement, vertical, dt);
        let is_astray = self.is_astray(measurement, setpoint);
        self.last = Some(*measurement);
        if is_frozen {
            Some(Inconsistency::Frozen)
        } else if is_turned {
            Some(Inconsistency::Orientation)
        } else if is_astray {
            Some(Inconsistency::Tracking)
        } else {
            None
        }
    }

    /// Forgets the past: the robot was set up anew.
    pub(crate) fn reset(&mut self) {
        *self = Self::new(self.parameters);
    }

    fn is_frozen(&mut self, measurement: &Measurement, commanded: &JointVector, dt: f64) -> bool {
        let Some(last) = &self.last else { return false };
        let moves = |joint: Joint| commanded[joint].abs() > MOVING;
        let is_moving = Joint::ALL.into_iter().any(moves);
        let count = |time: &mut f64, is_same: bool| {
            *time = if is_same { *time + dt } else { 0.0 };
            *time > FROZEN_MAX
        };
        let mut is_frozen = false;
        for joint in Joint::ALL {
            let is_same = moves(joint) && measurement.angles[joint] == last.angles[joint];
            is_frozen |= count(&mut self.frozen_joints[joint], is_same);
        }
        let same = [
            measurement.rates == last.rates,
            measurement.feet[0] == last.feet[0],
            measurement.feet[1] == last.feet[1],
            measurement.orientation == last.orientation,
            measurement.angular_rate == last.angular_rate,
        ];
        let is_loaded = measurement.feet.map(|foot| foot.force.z.abs() > LOADED);
        let must_change = [true, is_loaded[0], is_loaded[1], true, true];
        for (group, is_same) in same.into_iter().enumerate() {
            self.changed[group] = if is_same { 0 } else { self.changed[group].saturating_add(1) };
            self.is_noisy[group] |= self.changed[group] >= NOISY_AFTER;
            let is_suspect = is_moving && is_same && must_change[group] && self.is_noisy[group];
            is_frozen |= count(&mut self.frozen[group], is_suspect);
        }
        is_frozen
    }

    fn contradicts_gyro(&mut self, measurement: &Measurement, vertical: &Vector3<f64>, dt: f64) -> bool {
        let last_rate = self.last.map_or(measurement.angular_rate, |last| last.angular_rate);
        let rate = (measurement.angular_rate + last_rate) / 2.0;
        // u̇ = u × ω in trunk axes.
        let predicted = self.vertical.map_or(*vertical, |last| last + last.cross(&(rate * dt)));
        let error = vertical - predicted;
        let is_off = error.norm() > self.parameters.orientation_error_max;
        // What contradicts the gyro corrects nothing.
        let share = if is_off { 0.0 } else { dt / (CORRECTION_TIME_CONSTANT + dt) };
        let corrected = predicted + error * share;
        self.vertical = corrected.try_normalize(0.1).or(Some(*vertical));
        is_off
    }

    fn is_astray(&self, measurement: &Measurement, setpoint: &Setpoint) -> bool {
        // The first two joints are those of the foot on the ground, which nothing measures.
        Joint::ALL.into_iter().skip(2).any(|joint| {
            (measurement.angles[joint] - setpoint.angles[joint]).abs() > self.parameters.tracking_error_max
        })
    }
}
