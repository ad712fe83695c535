//! First-order low-pass filter.

use std::ops::{Add, Mul, Sub};

/// A first-order low-pass filter `τ·ẏ = x − y`, discretised by an implicit Euler step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowPass<T> {
    /// `τ` (s).
    time_constant: f64,
    value: T,
}

impl<T> LowPass<T>
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    /// A filter that has settled at `value`.
    ///
    /// * `time_constant` – `τ` (s); 0 passes every input through
    pub const fn new(time_constant: f64, value: T) -> Self {
        Self { time_constant, value }
    }

    /// Filters an input that lasts for `dt` (s), and returns the new output.
    pub fn update(&mut self, input: T, dt: f64) -> T {
        self.value = self.value + (input - self.value) * (dt / (dt + self.time_constant));
        self.value
    }

    /// The output `y`.
    pub fn value(&self) -> T {
        self.value
    }

    /// The same filter with its output replaced by `change` of it, as when the output is expressed in another frame.
    #[must_use]
    pub fn map(self, change: impl FnOnce(T) -> T) -> Self {
        Self { value: change(self.value), ..self }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    /// The oracle: the analytic step response 1 − e^(−t/τ).
    #[test]
    fn low_pass_answers_a_step_as_the_analytic_solution() {
        let (time_constant, dt, step) = (0.05, 1e-5, Vector2::new(2.0, -1.0));
        let mut filter = LowPass::new(time_constant, Vector2::zeros());
        for tick in 1..=20_000 {
            let output = filter.update(step, dt);
            let expected = step * (1.0 - (-f64::from(tick) * dt / time_constant).exp());
            assert!((output - expected).norm() < 5e-4, "tick {tick}: {output} instead of {expected}");
        }
    }

    #[test]
    fn low_pass_without_a_time_constant_passes_its_input_through() {
        let mut filter = LowPass::new(0.0, 7.0);
        assert_eq!(filter.update(-3.0, 1e-3), -3.0);
        assert_eq!(filter.map(|value| -value).value(), 3.0);
    }

    #[test]
    fn low_pass_is_stable_for_a_huge_step() {
        let mut filter = LowPass::new(1e-3, 0.0);
        let output = filter.update(1.0, 1e6);
        assert!((0.999..=1.0).contains(&output), "{output}");
    }
}
