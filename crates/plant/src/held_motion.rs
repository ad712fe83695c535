//! The motion of the held joints, which the controller does not know to move.

use heapless::Vec;
use model::HeldLink;

/// Motion of the held joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeldMotion {
    /// Angles against those at which they are held (rad).
    pub deflections: Vec<f64, { HeldLink::COUNT_MAX }>,
    /// Rates (rad/s).
    pub rates: Vec<f64, { HeldLink::COUNT_MAX }>,
}

impl HeldMotion {
    /// At rest, each where it is held.
    pub fn undeflected(count: usize) -> Self {
        let zeros: Vec<f64, { HeldLink::COUNT_MAX }> = std::iter::repeat_n(0.0, count).collect();
        Self { deflections: zeros.clone(), rates: zeros }
    }

    /// The same deflections at rest.
    #[must_use]
    pub fn at_rest(&self) -> Self {
        Self { deflections: self.deflections.clone(), ..Self::undeflected(self.rates.len()) }
    }

    /// Rate of a joint (rad/s).
    pub fn rate(&self, index: usize) -> f64 {
        self.rates.get(index).copied().unwrap_or(0.0)
    }

    /// Advances by `step` (s) with accelerations (rad/s²): rates first, then deflections with the new rates.
    pub fn integrate(&mut self, accelerations: impl Iterator<Item = f64>, step: f64) {
        for ((deflection, rate), acceleration) in self.deflections.iter_mut().zip(&mut self.rates).zip(accelerations) {
            *rate += acceleration * step;
            *deflection += *rate * step;
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.deflections.iter().chain(&self.rates).all(|value| value.is_finite())
    }
}
