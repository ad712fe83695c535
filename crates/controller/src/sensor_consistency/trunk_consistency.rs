//! Orientation and gyro of the trunk against each other.

use interface::{Fault, Measurement, Rejection, Sensor};
use nalgebra::Vector3;

/// Time constant with which the predicted vertical is corrected by the measured one (s).
const CORRECTION_TIME_CONSTANT: f64 = 0.2;
/// Longest gap between samples over which the gyro's rate can be integrated (s).
const INTEGRABLE: f64 = 0.01;

/// A complementary filter whose innovation is watched: the vertical that the gyro predicts, corrected slowly by the
/// measured one. Steps and drifts of the orientation, and bias, sign and scale of the gyro drive them apart.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TrunkConsistency {
    /// The vertical in trunk axes that the gyro predicts.
    vertical: Option<Vector3<f64>>,
}

impl TrunkConsistency {
    /// Absorbs a sample, and tells whether orientation and gyro contradict each other.
    ///
    /// * `vertical` – measured, in trunk axes (unit vector)
    /// * `error_max` – largest angle between the measured and the predicted vertical (rad)
    pub(super) fn update(
        &mut self,
        sample: &Measurement,
        last: &Measurement,
        vertical: &Vector3<f64>,
        error_max: f64,
        dt: f64,
    ) -> Option<Rejection> {
        if dt > INTEGRABLE {
            *self = Self::default();
        }
        let rate = (sample.angular_rate + last.angular_rate) / 2.0;
        // u̇ = u × ω in trunk axes.
        let predicted = self.vertical.map_or(*vertical, |last| last + last.cross(&(rate * dt)));
        let error = vertical - predicted;
        let is_off = error.norm() > error_max;
        // What contradicts the gyro corrects nothing.
        let share = if is_off { 0.0 } else { dt / (CORRECTION_TIME_CONSTANT + dt) };
        let corrected = predicted + error * share;
        self.vertical = corrected.try_normalize(0.1).or(Some(*vertical));
        is_off.then_some(Rejection { fault: Fault::MeasurementInconsistent, sensor: Sensor::Orientation })
    }
}
