//! The slope of the ground that the plan follows: on a slope a body is balanced when its centre of mass is above the
//! sole along the vertical, not along the normal of the floor.

use nalgebra::Vector2;
use signal::{CriticallyDamped, LowPass};

use crate::proportions::PatternProportions;

/// The lean of the vertical over the floor, in the walk frame: x and y of the unit vector. The planned lean is a
/// critically damped lag of the sensed one: drives and soles yield within a step and noise is white, but a slope stays
/// over several half-steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlannedSlope {
    sensed: LowPass<Vector2<f64>>,
    planned: CriticallyDamped<Vector2<f64>>,
    /// Time constant of the lag (s).
    time_constant: f64,
}

/// The steepest slope that is believed, as the sine of 12°. A robot that tilts more does not stand on its soles.
const LEAN_MAX: f64 = 0.208;

impl PlannedSlope {
    /// Level ground.
    pub(crate) fn new(proportions: &PatternProportions) -> Self {
        Self {
            sensed: LowPass::new(proportions.sensed_vertical_time_constant, Vector2::zeros()),
            planned: CriticallyDamped::default(),
            time_constant: proportions.slope_time_constant,
        }
    }

    /// Absorbs a measurement.
    ///
    /// * `lean` – of the vertical over the ground, in the walk frame (-)
    /// * `dt` – how long it lasted (s)
    pub(crate) fn update(&mut self, lean: Vector2<f64>, dt: f64) {
        self.sensed.update(lean.cap_magnitude(LEAN_MAX), dt);
    }

    /// Lets the planned lean follow the sensed one for `dt` (s), measured or not: the centre of mass moves with it, and
    /// must not jerk whenever a sole tips.
    pub(crate) fn advance(&mut self, dt: f64) {
        self.planned.advance(self.sensed.value(), self.time_constant, dt);
    }

    /// Lean of the vertical over the floor as sensed, in the walk frame (-).
    pub(crate) fn sensed(&self) -> Vector2<f64> {
        self.sensed.value()
    }

    /// Lean of the vertical over the floor as planned, in the walk frame (-).
    pub(crate) fn planned(&self) -> Vector2<f64> {
        self.planned.value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The oracle: a critically damped lag answers a step with 1 − (1 + t/τ)·e^(−t/τ).
    #[test]
    fn slope_is_sensed_at_once_and_planned_after_a_few_half_steps() {
        let step = Vector2::new(0.03, -0.02);
        let time_constant = PatternProportions::of_built_in_robot().slope_time_constant;
        let mut slope = PlannedSlope::new(&PatternProportions::of_built_in_robot());
        (0..1000).for_each(|_| slope.update(step, 1e-3));
        assert!((slope.sensed() - step).norm() < 1e-6);
        for tick in 1..=18_000 {
            slope.advance(1e-3);
            let t = f64::from(tick) * 1e-3 / time_constant;
            let expected = step * (1.0 - (1.0 + t) * (-t).exp());
            assert!((slope.planned() - expected).norm() < 2e-4, "{t}: {} instead of {expected}", slope.planned());
        }
        assert!((slope.planned() - step).norm() < 1e-5);
    }

    /// Measurements that come now and then do not move the centre of mass by jerks: its acceleration stays that of the
    /// lag, lean/τ² times the height, to which the ZMP is proportional.
    #[test]
    fn planned_slope_is_smooth_when_measurements_come_now_and_then() {
        let time_constant = PatternProportions::of_built_in_robot().slope_time_constant;
        let mut slope = PlannedSlope::new(&PatternProportions::of_built_in_robot());
        let mut last = [0.0; 2];
        for knot in 0..300 {
            if knot / 3 % 2 == 0 {
                (0..10).for_each(|_| slope.update(Vector2::new(0.035, 0.0), 1e-3));
            }
            slope.advance(0.01);
            let acceleration = (slope.planned().x - 2.0 * last[1] + last[0]) / 1e-4;
            assert!(acceleration.abs() <= 0.035 / (time_constant * time_constant), "knot {knot}: {acceleration} 1/s²");
            last = [last[1], slope.planned().x];
        }
    }

    #[test]
    fn slope_of_a_falling_robot_is_limited() {
        let mut slope = PlannedSlope::new(&PatternProportions::of_built_in_robot());
        for _ in 0..30_000 {
            slope.update(Vector2::new(0.6, 0.0), 1e-3);
            slope.advance(1e-3);
        }
        assert!((slope.planned().norm() - LEAN_MAX).abs() < 1e-6);
    }
}
