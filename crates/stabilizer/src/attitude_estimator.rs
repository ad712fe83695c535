//! The attitude of the trunk with the bias of its gyro: a complementary filter on rotations (Mahony, Hamel and Pflimlin
//! 2008, "Nonlinear complementary filters on the special orthogonal group").
//!
//! The gyro says how the trunk turns, at once and with little noise; the measured orientation says where that leads,
//! with noise. What keeps driving them apart is the gyro's bias.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Time constant with which the attitude follows the measured orientation (s): over it noise is averaged.
const ORIENTATION_TIME_CONSTANT: f64 = 0.05;
/// Time constant with which the bias is learnt (s): longer than a step, shorter than a bias takes to change.
const BIAS_TIME_CONSTANT: f64 = 2.0;
/// Largest bias (rad/s): 3°/s. A gyro that is off by more contradicts the orientation.
const BIAS_MAX: f64 = 0.0524;
/// Rotation between attitude and measured orientation up to which it teaches a bias (rad): more than the largest bias
/// leads to. A jump of the orientation is no bias.
const BIAS_SHOWS_BELOW: f64 = 0.004;
/// Rotation between attitude and measured orientation beyond which the attitude begins anew (rad): 1.1°, more than
/// noise and bias lead to. The trunk was moved by others.
const LOST: f64 = 0.02;
/// Longest time for which the gyro alone tells the attitude (s).
const GYRO_ALONE_MAX: f64 = 0.2;

/// The attitude of the trunk and the bias of its gyro. Everything is in physical coordinates: nothing is mirrored.
#[derive(Clone, Copy, Debug, Default)]
pub struct AttitudeEstimator {
    /// Maps trunk coordinates to level axes; once it was measured.
    attitude: Option<UnitQuaternion<f64>>,
    /// Bias of the gyro, in trunk axes (rad/s).
    bias: Vector3<f64>,
    /// The last angular rate, bias included (rad/s).
    rate: Option<Vector3<f64>>,
    /// Time since the last measured orientation (s).
    unmeasured_for: f64,
}

impl AttitudeEstimator {
    /// Absorbs a sample.
    ///
    /// * `orientation` – measured, if it is valid
    /// * `rate` – measured angular rate of the trunk in its axes, if it is valid (rad/s)
    /// * `dt` – time since the last sample (s)
    pub fn update(&mut self, orientation: Option<&Quaternion<f64>>, rate: Option<&Vector3<f64>>, dt: f64) {
        self.unmeasured_for += dt;
        let before = self.rate;
        self.rate = rate.copied();
        let mean = match (before, self.rate) {
            (Some(before), Some(now)) => Some((before + now) / 2.0 - self.bias),
            (one, other) => one.or(other).map(|rate| rate - self.bias),
        };
        let turned = self.attitude.map(|attitude| attitude * small_rotation(mean.unwrap_or_default() * dt));
        self.attitude = turned;
        let Some(measured) = orientation else { return };
        self.unmeasured_for = 0.0;
        let measured = UnitQuaternion::new_normalize(*measured);
        let Some(predicted) = turned else {
            self.attitude = Some(measured);
            return;
        };
        let error = rotation_vector(&(predicted.inverse() * measured));
        if error.norm() > LOST {
            self.attitude = Some(measured);
            return;
        }
        // Without a gyro nothing but the orientation tells the attitude.
        let share = if mean.is_some() { dt / (ORIENTATION_TIME_CONSTANT + dt) } else { 1.0 };
        self.attitude = Some(predicted * small_rotation(error * share));
        if mean.is_some() && error.norm() < BIAS_SHOWS_BELOW {
            let bias = self.bias - error * (dt / (ORIENTATION_TIME_CONSTANT * BIAS_TIME_CONSTANT));
            self.bias = bias.map(|bias| bias.clamp(-BIAS_MAX, BIAS_MAX));
        }
    }

    /// The attitude, which maps trunk coordinates to level axes; `None` when no orientation was measured for too long.
    pub fn attitude(&self) -> Option<UnitQuaternion<f64>> {
        self.attitude.filter(|_| self.unmeasured_for < GYRO_ALONE_MAX)
    }

    /// The vertical in trunk axes (unit vector); `None` as for [`attitude`](Self::attitude).
    pub fn up_in_trunk(&self) -> Option<Vector3<f64>> {
        self.attitude().map(|attitude| attitude.inverse() * Vector3::z())
    }

    /// The bias of the gyro, in trunk axes (rad/s).
    pub fn gyro_bias(&self) -> Vector3<f64> {
        self.bias
    }
}

/// The rotation by a small rotation vector (rad), to third order.
fn small_rotation(vector: Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::from_parts(1.0, vector / 2.0))
}

/// The vector of a small rotation (rad), to third order.
fn rotation_vector(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (scalar, vector) = (rotation.w, rotation.imag());
    vector * if scalar < 0.0 { -2.0 } else { 2.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: f64 = 1e-3;

    /// A trunk that rolls and pitches to and fro while it turns: its true attitude and rate in its axes, by
    /// differences.
    fn truth(time: f64) -> (UnitQuaternion<f64>, Vector3<f64>) {
        let at = |time: f64| {
            let (roll, pitch) = (0.05 * (5.0 * time).sin(), 0.08 * (3.0 * time).cos());
            UnitQuaternion::from_euler_angles(roll, pitch, 0.3 * time)
        };
        let h = 1e-6;
        let turned = at(time - h).inverse() * at(time + h);
        (at(time), turned.scaled_axis() / (2.0 * h))
    }

    #[test]
    fn a_constant_bias_converges_to_the_truth_while_the_trunk_moves() {
        let bias = Vector3::new(0.01, -0.008, 0.015);
        let mut estimator = AttitudeEstimator::default();
        for tick in 0..40_000 {
            let (attitude, rate) = truth(f64::from(tick) * PERIOD);
            estimator.update(Some(&attitude), Some(&(rate + bias)), PERIOD);
            if tick > 30_000 {
                assert!((estimator.gyro_bias() - bias).norm() < 2e-4, "{}", estimator.gyro_bias());
                assert!(estimator.attitude().unwrap().angle_to(&attitude) < 1e-4);
            }
        }
    }

    #[test]
    fn the_gyro_alone_tells_the_attitude_for_a_fifth_of_a_second() {
        let mut estimator = AttitudeEstimator::default();
        for tick in 0..1200 {
            let (attitude, rate) = truth(f64::from(tick) * PERIOD);
            estimator.update((tick < 1000).then_some(&attitude), Some(&rate), PERIOD);
            let expected = (tick < 1199).then_some(attitude);
            let apart = estimator.attitude().zip(expected).map(|(estimated, expected)| estimated.angle_to(&expected));
            assert_eq!(estimator.attitude().is_some(), expected.is_some(), "tick {tick}");
            assert!(apart.is_none_or(|apart| apart < 1e-4), "tick {tick}: {apart:?}");
        }
    }

    #[test]
    fn without_a_gyro_the_measured_orientation_is_the_attitude() {
        let mut estimator = AttitudeEstimator::default();
        for tick in 0..300 {
            let (attitude, _) = truth(f64::from(tick) * 0.01);
            estimator.update(Some(&attitude), None, 0.01);
            assert!(estimator.attitude().unwrap().angle_to(&attitude) < 1e-5);
        }
        assert_eq!(estimator.gyro_bias(), Vector3::zeros());
    }

    #[test]
    fn noise_of_the_orientation_is_averaged() {
        let mut estimator = AttitudeEstimator::default();
        let (attitude, _) = truth(0.0);
        let mut largest: f64 = 0.0;
        for tick in 0..2000 {
            let noise = if tick % 2 == 0 { 0.01 } else { -0.01 };
            let noisy = attitude * UnitQuaternion::from_euler_angles(noise, 0.0, 0.0);
            estimator.update(Some(&noisy), Some(&Vector3::zeros()), PERIOD);
            if tick > 1000 {
                largest = largest.max(estimator.attitude().unwrap().angle_to(&attitude));
            }
        }
        assert!(largest < 3e-4, "{largest}");
    }
}
