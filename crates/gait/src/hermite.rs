//! Quintic Hermite interpolation: what meets two neighbours in value, rate and acceleration, and so joins with C².

use model::{Motion, PerJoint};

/// The motion at `x` from 0 to 1 between two motions that are `h` seconds apart: C² where intervals join.
pub fn interpolate(start: &Motion, end: &Motion, x: f64, h: f64) -> Motion {
    let hermite = Hermite::new(x, h);
    let jets = PerJoint::from_fn(|joint| {
        hermite.between(
            [start.angles[joint], start.rates[joint], start.accelerations[joint]],
            [end.angles[joint], end.rates[joint], end.accelerations[joint]],
        )
    });
    Motion {
        angles: PerJoint::from_fn(|joint| jets[joint][0]),
        rates: PerJoint::from_fn(|joint| jets[joint][1]),
        accelerations: PerJoint::from_fn(|joint| jets[joint][2]),
    }
}

/// The weights of both ends' values, rates and accelerations at one point of an interval, for any number of joints.
pub(crate) struct Hermite {
    value: Weights,
    rate: Weights,
    acceleration: Weights,
}

/// A value with its first and second time derivative.
pub(crate) type Jet = [f64; 3];

/// Weights of: rate and acceleration at the start, the values' difference, rate and acceleration at the end. The start's
/// own value has weight 1 in the value and 0 in its derivatives.
type Weights = [f64; 5];

impl Hermite {
    /// At `x` from 0 to 1 in an interval that takes `h` seconds.
    pub(crate) fn new(x: f64, h: f64) -> Self {
        let (x2, x3, x4, x5) = (x * x, x.powi(3), x.powi(4), x.powi(5));
        let value = [
            x - 6.0 * x3 + 8.0 * x4 - 3.0 * x5,
            0.5 * x2 - 1.5 * x3 + 1.5 * x4 - 0.5 * x5,
            10.0 * x3 - 15.0 * x4 + 6.0 * x5,
            -4.0 * x3 + 7.0 * x4 - 3.0 * x5,
            0.5 * x3 - x4 + 0.5 * x5,
        ];
        let first = [
            1.0 - 18.0 * x2 + 32.0 * x3 - 15.0 * x4,
            x - 4.5 * x2 + 6.0 * x3 - 2.5 * x4,
            30.0 * x2 - 60.0 * x3 + 30.0 * x4,
            -12.0 * x2 + 28.0 * x3 - 15.0 * x4,
            1.5 * x2 - 4.0 * x3 + 2.5 * x4,
        ];
        let second = [
            -36.0 * x + 96.0 * x2 - 60.0 * x3,
            1.0 - 9.0 * x + 18.0 * x2 - 10.0 * x3,
            60.0 * x - 180.0 * x2 + 120.0 * x3,
            -24.0 * x + 84.0 * x2 - 60.0 * x3,
            3.0 * x - 12.0 * x2 + 10.0 * x3,
        ];
        // Rates and accelerations count per interval in x, and per second outside.
        let scale = |weights: Weights, derivative: i32| {
            let per = h.powi(-derivative);
            let [v0, a0, step, v1, a1] = weights;
            [v0 * h * per, a0 * h * h * per, step * per, v1 * h * per, a1 * h * h * per]
        };
        Self { value: scale(value, 0), rate: scale(first, 1), acceleration: scale(second, 2) }
    }

    /// Between one joint's state at the start and at the end of the interval.
    #[inline]
    pub(crate) fn between(&self, start: Jet, end: Jet) -> Jet {
        let data = [start[1], start[2], end[0] - start[0], end[1], end[2]];
        let dot = |weights: &Weights| weights.iter().zip(&data).map(|(weight, value)| weight * value).sum::<f64>();
        [start[0] + dot(&self.value), dot(&self.rate), dot(&self.acceleration)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Any quintic is its own interpolant: compare with one in closed form.
    #[test]
    fn a_quintic_is_interpolated_exactly() {
        let quintic = |t: f64| -> Jet {
            [
                1.0 - 2.0 * t + 3.0 * t.powi(2) - t.powi(3) + 0.5 * t.powi(4) - 0.7 * t.powi(5),
                -2.0 + 6.0 * t - 3.0 * t.powi(2) + 2.0 * t.powi(3) - 3.5 * t.powi(4),
                6.0 - 6.0 * t + 6.0 * t.powi(2) - 14.0 * t.powi(3),
            ]
        };
        let h = 0.4;
        for step in 0..=20 {
            let x = f64::from(step) / 20.0;
            let found = Hermite::new(x, h).between(quintic(0.0), quintic(h));
            for (found, expected) in found.into_iter().zip(quintic(x * h)) {
                assert!((found - expected).abs() < 1e-12, "x = {x}: {found} instead of {expected}");
            }
        }
    }
}
