//! The floor's tilt, as the bearing soles tell it: on a slope a body is balanced when its centre of mass is above the sole
//! along the vertical, not along the floor's normal.

use nalgebra::Vector2;

/// The vertical against the floor, in the walk frame. A critically damped second-order lag of what is sensed: servos and
/// soles give way within a step and noise is white, but a floor is what stays over several half-steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Floor {
    /// How the vertical leans in axes of the floor: x and y of the unit vector [-].
    lean: Vector2<f64>,
    /// [1/s]
    rate: Vector2<f64>,
}

/// Of the lag [s].
const TIME_CONSTANT: f64 = 0.5;
/// The steepest floor that is believed: 6°. A robot that tilts more does not stand on its soles.
const LEAN_MAX: f64 = 0.105;

impl Floor {
    /// Absorbs how the vertical leans over a sole that bears, `dt` seconds after the last time.
    pub fn update(&mut self, sensed: Vector2<f64>, dt: f64) {
        let target = sensed.cap_magnitude(LEAN_MAX);
        let pull = (target - self.lean) * (dt / (TIME_CONSTANT * TIME_CONSTANT));
        self.rate = (self.rate + pull) / (1.0 + dt / TIME_CONSTANT).powi(2);
        self.lean += self.rate * dt;
    }

    /// How the vertical leans, in the walk frame: x and y of the unit vector [-].
    pub fn lean(&self) -> Vector2<f64> {
        self.lean
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The oracle: a critically damped lag answers a step with 1 − (1 + t/τ)·e^(−t/τ).
    #[test]
    fn a_slope_is_known_after_a_few_half_steps() {
        let step = Vector2::new(0.03, -0.02);
        let mut floor = Floor::default();
        for tick in 1..=6000 {
            floor.update(step, 1e-3);
            let t = f64::from(tick) * 1e-3 / TIME_CONSTANT;
            let expected = step * (1.0 - (1.0 + t) * (-t).exp());
            assert!((floor.lean() - expected).norm() < 2e-4, "{t}: {} instead of {expected}", floor.lean());
        }
        assert!((floor.lean() - step).norm() < 1e-5);
    }

    #[test]
    fn a_robot_that_falls_is_no_slope() {
        let mut floor = Floor::default();
        for _ in 0..9000 {
            floor.update(Vector2::new(0.6, 0.0), 1e-3);
        }
        assert!((floor.lean().norm() - LEAN_MAX).abs() < 1e-6);
    }
}
