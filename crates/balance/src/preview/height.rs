//! The height of the swinging sole over a body that tilts: without it a sole that swings ahead of a robot pushed forward
//! hits the ground early, and the weight goes to it before its time.

use nalgebra::Vector2;

/// By how much the swinging sole is held higher than planned, so that it is where it was planned over the real floor. A
/// critically damped second-order lag, knot by knot.
#[derive(Clone, Copy, Debug, Default)]
pub struct Height {
    /// [m]
    value: f64,
    /// [m/s]
    rate: f64,
}

/// Of the lag [s].
const TIME_CONSTANT: f64 = 0.08;
/// [m]
const VALUE_MAX: f64 = 0.03;

impl Height {
    /// Moves on by `dt` [s].
    ///
    /// * `tilt` – how the body is turned beyond the plan, about x and y [rad]
    /// * `sole` – where the swinging sole is, in support coordinates [m]
    pub fn advance(&mut self, tilt: Vector2<f64>, sole: Vector2<f64>, dt: f64) {
        let lost = tilt.x * sole.y - tilt.y * sole.x;
        let target = (-lost).clamp(-VALUE_MAX, VALUE_MAX);
        let pull = (target - self.value) * (dt / (TIME_CONSTANT * TIME_CONSTANT));
        self.rate = (self.rate + pull) / (1.0 + dt / TIME_CONSTANT).powi(2);
        self.value += self.rate * dt;
    }

    /// The other foot bears: what was higher is where the height is told from.
    pub fn swap(&mut self) {
        *self = Self { value: -self.value, rate: -self.rate };
    }

    /// Of the swinging sole [m].
    pub fn of_sole(&self) -> f64 {
        self.value
    }

    /// Of the hips: half as much, so that nothing jumps at a swap [m].
    pub fn of_hips(&self) -> f64 {
        self.value / 2.0
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector3};

    use super::*;

    /// The oracle: the body turned about O takes the sole along.
    #[test]
    fn the_sole_stays_where_it_was_planned() {
        let (tilt, sole) = (Vector2::new(0.02, 0.03), Vector2::new(0.2, 0.19));
        let mut height = Height::default();
        for _ in 0..100 {
            height.advance(tilt, sole, 0.01);
        }
        let turned = Rotation3::new(tilt.push(0.0)) * Vector3::new(sole.x, sole.y, height.of_sole());
        assert!(turned.z.abs() < 2e-4, "{}", turned.z);
    }

    #[test]
    fn nothing_jumps_at_a_swap() {
        let mut height = Height::default();
        height.advance(Vector2::new(0.02, 0.03), Vector2::new(0.2, 0.19), 0.01);
        let before = [height.of_hips(), height.of_hips() - height.of_sole()];
        height.swap();
        let after = [height.of_hips() - height.of_sole(), height.of_hips()];
        assert_eq!(before, after, "of the hips over one and the other foot");
    }
}
