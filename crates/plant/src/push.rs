//! Pushes: forces on a link that the controller does not expect.

use model::Joint;
use nalgebra::Vector3;

/// A constant force on a link's centre of mass for a limited time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// The pushed link, by the joint that carries it.
    pub link: Joint,
    /// Impulse of the push, force times duration, in world axes (N·s).
    pub impulse: Vector3<f64>,
    /// Start of the push, since the plant's start (s).
    pub start: f64,
    /// Duration of the push, greater than 0 (s).
    pub duration: f64,
}

impl Push {
    /// Mean force over the integration step between two times since the plant's start (s), in world axes (N). A step
    /// that the push covers in part gets that part, so that the impulse does not depend on the step length.
    pub fn force_over(&self, from: f64, to: f64) -> Vector3<f64> {
        let covered = to.min(self.start + self.duration) - from.max(self.start);
        if covered > 0.0 { self.impulse * (covered / (self.duration * (to - from))) } else { Vector3::zeros() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of a quarter of a millisecond; pushes that begin and end within them, shorter than one, and longer.
    #[test]
    fn the_impulse_of_a_push_does_not_depend_on_the_step_length() {
        let step = 2.5e-4;
        for (start, duration) in [(1.0, 0.1), (0.123_456_7, 0.054_321), (0.500_01, 1e-5), (0.0, 1.9), (0.300_1, 1e-3)] {
            let impulse = Vector3::new(12.0, -7.0, 3.0);
            let push = Push { link: Joint::WaistRoll, impulse, start, duration };
            let given: Vector3<f64> =
                (0..8000).map(|n| push.force_over(f64::from(n) * step, f64::from(n + 1) * step) * step).sum();
            assert!((given - impulse).norm() < 1e-9 * impulse.norm(), "from {start} s for {duration} s: {given}");
        }
    }
}
