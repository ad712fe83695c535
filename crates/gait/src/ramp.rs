//! Ramps: how an offset or a speed goes from its present to its commanded value (DESIGN §4.4).
//!
//! The paper adds equal increments: [`RampKind::Linear`], which jumps in rate at both ends. The default is a quintic
//! that starts from the present value, rate and acceleration and ends at rest: smooth for every sequence of commands.

use signal::quintic_to_rest;

/// The shape of a ramp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RampKind {
    /// Equal increments, as in the paper: continuous in value only.
    Linear,
    /// Continuous in value, rate and acceleration.
    #[default]
    Quintic,
}

/// A value with its first and second derivative by the variable of the ramp.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RampState {
    /// The value of the ramp: an offset (rad) or a speed factor (-).
    pub value: f64,
    /// First derivative of the value by the variable of the ramp, which has no unit itself (-), or by time (1/s).
    pub rate: f64,
    /// Second derivative of the value by the variable of the ramp (-), or by time (1/s²).
    pub acceleration: f64,
}

impl RampState {
    /// A value at rest.
    pub const fn at_rest(value: f64) -> Self {
        Self { value, rate: 0.0, acceleration: 0.0 }
    }

    /// The same with derivatives by another variable, where `dx` is the derivative of the ramp's variable by that one:
    /// by time, if `dx` is the share of the ramp that passes in a second (1/s).
    pub fn by(self, dx: f64) -> Self {
        Self { value: self.value, rate: self.rate * dx, acceleration: self.acceleration * dx * dx }
    }

    /// The mirror image of an offset that changes its sign at the support change.
    pub fn negated(self) -> Self {
        Self { value: -self.value, rate: -self.rate, acceleration: -self.acceleration }
    }
}

/// A ramp: a polynomial in `x` from 0, or from where it was redirected, to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// Coefficients of 1, u, u² … u⁵, where `u` goes from 0 to 1 with `x`.
    coefficients: [f64; 6],
    /// `x` where it begins, and `du/dx`.
    from: f64,
    rate: f64,
    /// State at x = 1, free of the polynomial's rounding, so that an offset that is removed is removed exactly.
    end: RampState,
}

impl Ramp {
    /// A ramp of a kind from a state to the value `to`. A linear one takes over the value only.
    pub fn new(kind: RampKind, from: RampState, to: f64) -> Self {
        match kind {
            RampKind::Linear => Self::linear(from.value, to),
            RampKind::Quintic => Self::quintic(from, to),
        }
    }

    /// A ramp that stays at a value.
    pub const fn hold(value: f64) -> Self {
        Self { coefficients: [value, 0.0, 0.0, 0.0, 0.0, 0.0], from: 0.0, rate: 1.0, end: RampState::at_rest(value) }
    }

    /// A ramp in equal increments from `from` to `to`.
    pub fn linear(from: f64, to: f64) -> Self {
        let rate = to - from;
        let coefficients = [from, rate, 0.0, 0.0, 0.0, 0.0];
        Self { coefficients, from: 0.0, rate: 1.0, end: RampState { value: to, rate, acceleration: 0.0 } }
    }

    /// A ramp from a value, rate and acceleration to rest at `to`.
    pub fn quintic(from: RampState, to: f64) -> Self {
        let coefficients = quintic_to_rest(from.value, from.rate, from.acceleration, to);
        Self { coefficients, from: 0.0, rate: 1.0, end: RampState::at_rest(to) }
    }

    /// The ramp that leaves this one at `x` < 1 and ends at the value `to`.
    #[must_use]
    pub fn redirected(&self, kind: RampKind, x: f64, to: f64) -> Self {
        let rate = (1.0 - x).recip();
        let ramp = Self::new(kind, self.at(x).by(1.0 - x), to);
        let end = RampState { rate: ramp.end.rate * rate, ..ramp.end };
        Self { from: x, rate, end, ..ramp }
    }

    /// The state at `x`; beyond 1 the state at 1, and before a redirected ramp begins the value there, at rest.
    pub fn at(&self, x: f64) -> RampState {
        if x >= 1.0 {
            return self.end;
        }
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        let u = (x - self.from) * self.rate;
        if u < 0.0 {
            return RampState::at_rest(c0);
        }
        let rate = c1 + u * (2.0 * c2 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)));
        let acceleration = 2.0 * c2 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5));
        RampState {
            value: c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5)))),
            rate: rate * self.rate,
            acceleration: acceleration * self.rate * self.rate,
        }
    }

    /// The state at x = 1.
    pub fn end(&self) -> RampState {
        self.end
    }

    /// The integral of the value from 0 to `x` ≤ 1 of a ramp that was not redirected.
    pub fn integral(&self, x: f64) -> f64 {
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        x * (c0 + x * (c1 / 2.0 + x * (c2 / 3.0 + x * (c3 / 4.0 + x * (c4 / 5.0 + x * c5 / 6.0)))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FROM: RampState = RampState { value: 0.3, rate: -2.0, acceleration: 5.0 };

    #[test]
    fn a_quintic_ramp_starts_from_the_given_state_and_ends_at_rest() {
        let ramp = Ramp::quintic(FROM, 1.1);
        assert_eq!(ramp.at(0.0), FROM);
        assert_eq!(ramp.at(1.0), RampState::at_rest(1.1));
        let almost = ramp.at(1.0 - 1e-12);
        assert!((almost.value - 1.1).abs() < 1e-12 && almost.rate.abs() < 1e-10 && almost.acceleration.abs() < 1e-9);
    }

    #[test]
    fn a_redirected_ramp_leaves_smoothly_and_ends_at_rest_at_the_new_value() {
        let first = Ramp::quintic(FROM, 1.1);
        let ramp = first.redirected(RampKind::Quintic, 0.4, -0.3).redirected(RampKind::Quintic, 0.55, 0.2);
        let (before, after) = (first.redirected(RampKind::Quintic, 0.4, -0.3).at(0.55), ramp.at(0.55));
        assert!((before.value - after.value).abs() < 1e-14 && (before.rate - after.rate).abs() < 1e-12);
        assert!((before.acceleration - after.acceleration).abs() < 1e-11);
        let almost = ramp.at(1.0 - 1e-9);
        assert!((almost.value - 0.2).abs() < 1e-9 && almost.rate.abs() < 1e-6 && almost.acceleration.abs() < 1e-5);
        assert_eq!(ramp.at(1.0), RampState::at_rest(0.2));
        let h = 1e-5;
        for x in [0.6, 0.8, 0.95] {
            let (before, here, after) = (ramp.at(x - h), ramp.at(x), ramp.at(x + h));
            assert!(((after.value - before.value) / (2.0 * h) - here.rate).abs() < 1e-6);
            assert!(((after.rate - before.rate) / (2.0 * h) - here.acceleration).abs() < 1e-4);
        }
    }

    #[test]
    fn derivatives_and_integral_of_ramps_agree_with_differences() {
        let h = 1e-5;
        for ramp in [Ramp::quintic(FROM, 1.1), Ramp::linear(0.2, -0.4), Ramp::hold(3.0)] {
            for step in 1..10 {
                let x = f64::from(step) / 10.0;
                let (before, here, after) = (ramp.at(x - h), ramp.at(x), ramp.at(x + h));
                assert!(((after.value - before.value) / (2.0 * h) - here.rate).abs() < 1e-7);
                assert!(((after.rate - before.rate) / (2.0 * h) - here.acceleration).abs() < 1e-6);
                let slope = (ramp.integral(x + h) - ramp.integral(x - h)) / (2.0 * h);
                assert!((slope - here.value).abs() < 1e-7);
            }
        }
    }
}
