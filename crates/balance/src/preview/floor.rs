//! The floor's tilt, as the bearing soles tell it: on a slope a body is balanced when its centre of mass is above the sole
//! along the vertical, not along the floor's normal.

use nalgebra::Vector2;

/// The vertical against the floor, in the walk frame. A critically damped second-order lag of what is sensed: servos and
/// soles give way within a step and noise is white, but a floor is what stays over several half-steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Floor {
    /// How the vertical leans in axes of the floor as soles now tell: x and y of the unit vector [-].
    now: Vector2<f64>,
    /// The same as the plan has come to take it.
    lean: Vector2<f64>,
    /// [1/s]
    rate: Vector2<f64>,
}

/// Of the lag [s].
const TIME_CONSTANT: f64 = 0.25;
/// Of what soles tell now [s].
const SOLE_TIME_CONSTANT: f64 = 0.05;
/// The steepest floor that is believed: 6°. A robot that tilts more does not stand on its soles.
const LEAN_MAX: f64 = 0.105;

impl Floor {
    /// Absorbs how the vertical leans over a sole that bears, `dt` seconds of it.
    pub fn sense(&mut self, sensed: Vector2<f64>, dt: f64) {
        self.now += (sensed.cap_magnitude(LEAN_MAX) - self.now) * (dt / (dt + SOLE_TIME_CONSTANT));
    }

    /// Moves on by `dt` [s], sensed or not: the centre of mass follows, and may not jerk whenever a sole tips.
    pub fn advance(&mut self, dt: f64) {
        let pull = (self.now - self.lean) * (dt / (TIME_CONSTANT * TIME_CONSTANT));
        self.rate = (self.rate + pull) / (1.0 + dt / TIME_CONSTANT).powi(2);
        self.lean += self.rate * dt;
    }

    /// How the vertical leans as soles now tell, in the walk frame: x and y of the unit vector [-].
    pub fn lean_now(&self) -> Vector2<f64> {
        self.now
    }

    /// How the vertical leans as the plan is to take it, in the walk frame: x and y of the unit vector [-].
    pub fn lean(&self) -> Vector2<f64> {
        self.lean
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The oracle: a critically damped lag answers a step with 1 − (1 + t/τ)·e^(−t/τ); what is sensed is there before.
    #[test]
    fn a_slope_is_known_after_a_few_half_steps() {
        let step = Vector2::new(0.03, -0.02);
        let mut floor = Floor::default();
        (0..1000).for_each(|_| floor.sense(step, 1e-3));
        assert!((floor.lean_now() - step).norm() < 1e-6);
        for tick in 1..=6000 {
            floor.advance(1e-3);
            let t = f64::from(tick) * 1e-3 / TIME_CONSTANT;
            let expected = step * (1.0 - (1.0 + t) * (-t).exp());
            assert!((floor.lean() - expected).norm() < 2e-4, "{t}: {} instead of {expected}", floor.lean());
        }
        assert!((floor.lean() - step).norm() < 1e-5);
    }

    /// Soles that tell something only now and then do not move the centre of mass by jerks: its acceleration stays that of
    /// the lag, lean/τ² times the height, to which the ZMP is proportional.
    #[test]
    fn the_plan_follows_smoothly_whenever_soles_tell() {
        let mut floor = Floor::default();
        let mut last = [0.0; 2];
        for knot in 0..300 {
            if knot / 3 % 2 == 0 {
                (0..10).for_each(|_| floor.sense(Vector2::new(0.035, 0.0), 1e-3));
            }
            floor.advance(0.01);
            let acceleration = (floor.lean().x - 2.0 * last[1] + last[0]) / 1e-4;
            assert!(acceleration.abs() <= 0.035 / (TIME_CONSTANT * TIME_CONSTANT), "knot {knot}: {acceleration} 1/s²");
            last = [last[1], floor.lean().x];
        }
    }

    #[test]
    fn a_robot_that_falls_is_no_slope() {
        let mut floor = Floor::default();
        for _ in 0..9000 {
            floor.sense(Vector2::new(0.6, 0.0), 1e-3);
            floor.advance(1e-3);
        }
        assert!((floor.lean().norm() - LEAN_MAX).abs() < 1e-6);
    }
}
