//! Quintic polynomials over 0 to 1 that come to rest at their end.

use std::ops::{Add, Mul, Sub};

/// Blends from 0 to 1 over `s` from 0 to 1, with rate and acceleration zero at both ends: `10s³ − 15s⁴ + 6s⁵`.
pub fn smooth_step(s: f64) -> f64 {
    s * s * s * (10.0 + s * (-15.0 + 6.0 * s))
}

/// Coefficients of 1, s, s² … s⁵ of the quintic that starts with a value, rate and acceleration at s = 0 and is at rest
/// at `end` at s = 1. Rate and acceleration are derivatives by s.
pub fn quintic_to_rest<T>(value: T, rate: T, acceleration: T, end: T) -> [T; 6]
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let way = end - value;
    [
        value,
        rate,
        acceleration * 0.5,
        way * 10.0 - rate * 6.0 - acceleration * 1.5,
        way * -15.0 + rate * 8.0 + acceleration * 1.5,
        way * 6.0 - rate * 3.0 - acceleration * 0.5,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Value and first two derivatives of a polynomial at `s`.
    fn evaluate(coefficients: &[f64; 6], s: f64) -> [f64; 3] {
        let (mut value, mut rate, mut acceleration) = (0.0, 0.0, 0.0);
        for (power, coefficient) in (0..).zip(coefficients) {
            let n = f64::from(power);
            value += coefficient * s.powi(power);
            rate += n * coefficient * s.powi((power - 1).max(0));
            acceleration += n * (n - 1.0) * coefficient * s.powi((power - 2).max(0));
        }
        [value, rate, acceleration]
    }

    #[test]
    fn quintic_meets_its_start_and_rests_at_its_end() {
        let coefficients = quintic_to_rest(0.3, -2.0, 5.0, 1.1);
        assert_eq!(evaluate(&coefficients, 0.0), [0.3, -2.0, 5.0]);
        let [value, rate, acceleration] = evaluate(&coefficients, 1.0);
        assert!((value - 1.1).abs() < 1e-14 && rate.abs() < 1e-13 && acceleration.abs() < 1e-12);
    }

    /// A blend from rest at 0 to rest at 1 is the quintic with these end conditions; there is only one.
    #[test]
    fn smooth_step_is_the_quintic_from_rest_to_rest() {
        let coefficients = quintic_to_rest(0.0, 0.0, 0.0, 1.0);
        for step in 0..=20 {
            let s = f64::from(step) / 20.0;
            let [expected, ..] = evaluate(&coefficients, s);
            assert!((smooth_step(s) - expected).abs() < 1e-15, "at {s}");
            assert!((smooth_step(s) + smooth_step(1.0 - s) - 1.0).abs() < 1e-15, "not symmetric at {s}");
        }
        assert_eq!((smooth_step(0.0), smooth_step(1.0)), (0.0, 1.0));
    }
}
