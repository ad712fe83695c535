//! Second-order lag with critical damping.

use std::ops::Add;

use crate::Signal;

/// A critically damped second-order lag `τ²·ÿ + 2τ·ẏ + y = x`, discretised by an implicit Euler step. Its output is
/// continuously differentiable whatever the input does, and never overshoots a constant one from rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CriticallyDamped<T> {
    /// The output `y`.
    pub value: T,
    /// Its rate `ẏ` (1/s).
    pub rate: T,
}

impl<T: Signal> CriticallyDamped<T> {
    /// Follows `target` for `dt` (s).
    ///
    /// * `time_constant` – `τ` (s), positive
    pub fn advance(&mut self, target: T, time_constant: f64, dt: f64) {
        let pull = (target - self.value) * (dt / (time_constant * time_constant));
        self.rate = critically_damped_rate(self.rate, pull, time_constant, dt);
        self.value = self.value + self.rate * dt;
    }
}

/// The rate of a [`CriticallyDamped`] lag after an implicit step of `dt` (s); for callers that keep value and rate
/// elsewhere, or whose `pull` must be rounded otherwise.
///
/// * `rate` – the rate before the step (1/s)
/// * `pull` – distance to the target times `dt/τ²` (1/s)
/// * `time_constant` – `τ` (s), positive
pub fn critically_damped_rate<T>(rate: T, pull: T, time_constant: f64, dt: f64) -> T
where
    T: Add<Output = T> + std::ops::Div<f64, Output = T>,
{
    (rate + pull) / (1.0 + dt / time_constant).powi(2)
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    /// The oracle: the analytic step response 1 − (1 + t/τ)·e^(−t/τ).
    #[test]
    fn critically_damped_lag_answers_a_step_as_the_analytic_solution() {
        let (time_constant, dt, step) = (0.25, 1e-4, Vector2::new(0.3, -2.0));
        let mut lag = CriticallyDamped { value: Vector2::zeros(), rate: Vector2::zeros() };
        for tick in 1..=30_000 {
            lag.advance(step, time_constant, dt);
            let t = f64::from(tick) * dt / time_constant;
            let expected = step * (1.0 - (1.0 + t) * (-t).exp());
            let expected_rate = step * (t * (-t).exp() / time_constant);
            assert!((lag.value - expected).norm() < 1e-3, "tick {tick}: {} instead of {expected}", lag.value);
            assert!((lag.rate - expected_rate).norm() < 5e-3, "tick {tick}: {} instead of {expected_rate}", lag.rate);
        }
    }

    #[test]
    fn critically_damped_lag_does_not_overshoot_a_step() {
        for dt in [1e-4, 1e-2, 1.0, 100.0] {
            let mut lag = CriticallyDamped::default();
            for _ in 0..1000 {
                lag.advance(1.0, 0.1, dt);
                assert!((0.0..=1.0 + 1e-12).contains(&lag.value), "dt {dt}: {}", lag.value);
            }
        }
    }
}
