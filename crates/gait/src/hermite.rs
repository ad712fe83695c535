//! Quintic Hermite interpolation: meets both neighbours in value, rate and acceleration, so that intervals join with
//! C².

use model::{JointVector, Motion};

/// The motion at `x`, from 0 to 1, between two motions that are `h` seconds apart: C² where intervals join.
pub fn interpolate(start: &Motion, end: &Motion, x: f64, h: f64) -> Motion {
    Motion {
        angles: interpolate_angles(start, end, x, h),
        rates: combined(start, end, rate_weights(x), h, h.recip()),
        accelerations: combined(start, end, acceleration_weights(x), h, (h * h).recip()),
    }
}

/// The angles of [`interpolate`] alone.
pub(crate) fn interpolate_angles(start: &Motion, end: &Motion, x: f64, h: f64) -> JointVector {
    start.angles + combined(start, end, value_weights(x), h, 1.0)
}

/// Weights of: rate and acceleration at the start, the difference of the values, rate and acceleration at the end, all
/// per interval. The value at the start has weight 1 in the value and 0 in its derivatives.
type Weights = [f64; 5];

fn value_weights(x: f64) -> Weights {
    let x2 = x * x;
    let (x3, x4, x5) = (x2 * x, x2 * x2, x2 * x2 * x);
    [
        x - 6.0 * x3 + 8.0 * x4 - 3.0 * x5,
        0.5 * x2 - 1.5 * x3 + 1.5 * x4 - 0.5 * x5,
        10.0 * x3 - 15.0 * x4 + 6.0 * x5,
        -4.0 * x3 + 7.0 * x4 - 3.0 * x5,
        0.5 * x3 - x4 + 0.5 * x5,
    ]
}

fn rate_weights(x: f64) -> Weights {
    let x2 = x * x;
    let (x3, x4) = (x2 * x, x2 * x2);
    [
        1.0 - 18.0 * x2 + 32.0 * x3 - 15.0 * x4,
        x - 4.5 * x2 + 6.0 * x3 - 2.5 * x4,
        30.0 * x2 - 60.0 * x3 + 30.0 * x4,
        -12.0 * x2 + 28.0 * x3 - 15.0 * x4,
        1.5 * x2 - 4.0 * x3 + 2.5 * x4,
    ]
}

fn acceleration_weights(x: f64) -> Weights {
    let x2 = x * x;
    let x3 = x2 * x;
    [
        -36.0 * x + 96.0 * x2 - 60.0 * x3,
        1.0 - 9.0 * x + 18.0 * x2 - 10.0 * x3,
        60.0 * x - 180.0 * x2 + 120.0 * x3,
        -24.0 * x + 84.0 * x2 - 60.0 * x3,
        3.0 * x - 12.0 * x2 + 10.0 * x3,
    ]
}

/// Joint by joint, the weighted sum of both ends of an interval of `h` seconds, times `scale`.
#[inline]
fn combined(start: &Motion, end: &Motion, weights: Weights, h: f64, scale: f64) -> JointVector {
    let [rate, acceleration, step, end_rate, end_acceleration] = weights;
    let (per_rate, per_acceleration) = (h * scale, h * h * scale);
    (end.angles - start.angles) * (step * scale)
        + start.rates * (rate * per_rate)
        + start.accelerations * (acceleration * per_acceleration)
        + end.rates * (end_rate * per_rate)
        + end.accelerations * (end_acceleration * per_acceleration)
}

#[cfg(test)]
mod tests {
    use model::Joint;

    use super::*;

    /// Any quintic is its own interpolant: compare with one in closed form.
    #[test]
    fn hermite_interpolation_reproduces_a_quintic_exactly() {
        let quintic = |t: f64| -> [f64; 3] {
            [
                1.0 - 2.0 * t + 3.0 * t.powi(2) - t.powi(3) + 0.5 * t.powi(4) - 0.7 * t.powi(5),
                -2.0 + 6.0 * t - 3.0 * t.powi(2) + 2.0 * t.powi(3) - 3.5 * t.powi(4),
                6.0 - 6.0 * t + 6.0 * t.powi(2) - 14.0 * t.powi(3),
            ]
        };
        let h = 0.4;
        let motion = |t: f64| {
            let jet = quintic(t);
            let [angles, rates, accelerations] =
                [0, 1, 2].map(|derivative| JointVector::unit(Joint::RightKnee) * jet[derivative]);
            Motion { angles, rates, accelerations }
        };
        for step in 0..=20 {
            let x = f64::from(step) / 20.0;
            let found = interpolate(&motion(0.0), &motion(h), x, h);
            let expected = motion(x * h);
            for (found, expected) in [
                (found.angles, expected.angles),
                (found.rates, expected.rates),
                (found.accelerations, expected.accelerations),
            ] {
                assert!((found - expected).max_abs() < 1e-12, "x = {x}: {found:?} instead of {expected:?}");
            }
        }
    }
}
