//! Step adjustment after a push: the swing foot lands off its planned place, by the error of the divergent component of
//! motion that is expected at touchdown (Englsberger, Ott and Albu-Schäffer 2015; Griffin et al. 2017).

use nalgebra::Vector2;
use signal::quintic_to_rest;

/// The offset of the swing sole over a half-step: a quintic from the present offset to its target, computed anew
/// whenever the target changes, so that the sole's acceleration is continuous and the sole lands at rest.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StepAdjustment {
    /// Coefficients of the polynomial over the rest of the half-step (m).
    coefficients: [Vector2<f64>; 6],
    /// Progress at which the polynomial begins.
    since: f64,
    /// Offset at the landing (m).
    target: Vector2<f64>,
}

/// Progress at which the sole has reached its place: before it touches down.
const IN_PLACE: f64 = 0.97;

impl StepAdjustment {
    /// Offset of the landing from its planned place (m).
    pub(crate) fn target(&self) -> Vector2<f64> {
        self.target
    }

    /// Whether the target may still change at a progress.
    pub(crate) fn is_in_time(progress: f64) -> bool {
        progress < IN_PLACE
    }

    /// Changes the target, while [`is_in_time`](Self::is_in_time).
    pub(crate) fn retarget(&mut self, progress: f64, target: Vector2<f64>) {
        let [value, rate, acceleration] = self.at(progress);
        let span = IN_PLACE - progress;
        self.coefficients = quintic_to_rest(value, rate * span, acceleration * (span * span), target);
        self.since = progress;
        self.target = target;
    }

    /// The offset at a progress (m), with its first and second derivative by the progress.
    pub(crate) fn at(&self, progress: f64) -> [Vector2<f64>; 3] {
        if progress >= IN_PLACE {
            return [self.target, Vector2::zeros(), Vector2::zeros()];
        }
        let span = IN_PLACE - self.since;
        let u = (progress - self.since) / span;
        let (mut value, mut rate, mut acceleration) = (Vector2::zeros(), Vector2::zeros(), Vector2::zeros());
        for coefficient in self.coefficients.iter().rev() {
            acceleration = acceleration * u + rate * 2.0;
            rate = rate * u + value;
            value = value * u + coefficient;
        }
        [value, rate / span, acceleration / (span * span)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn step_adjustment_is_smooth_when_retargeted_and_lands_at_rest() {
        let mut adjustment = StepAdjustment::default();
        for (progress, target) in [(0.2, Vector2::new(0.1, -0.03)), (0.55, Vector2::new(-0.02, 0.05))] {
            let before = adjustment.at(progress);
            adjustment.retarget(progress, target);
            let after = adjustment.at(progress);
            for (before, after) in before.iter().zip(after) {
                assert!((before - after).norm() < 1e-12 * (1.0 + before.norm()), "{before} {after}");
            }
            let [end, rate, acceleration] = adjustment.at(IN_PLACE - 1e-9);
            assert!((end - target).norm() < 1e-9 && rate.norm() < 1e-6 && acceleration.norm() < 1e-4);
        }
        assert_eq!(adjustment.at(1.0)[0], Vector2::new(-0.02, 0.05));
    }

    /// The oracle: derivatives by differences.
    #[test]
    fn step_adjustment_derivatives_agree_with_differences() {
        let mut adjustment = StepAdjustment::default();
        adjustment.retarget(0.1, Vector2::new(0.1, -0.03));
        adjustment.retarget(0.4, Vector2::new(0.05, 0.02));
        let h = 1e-5;
        for progress in [0.45, 0.6, 0.85] {
            let [[before, ..], [here, rate, acceleration], [after, ..]] =
                [-h, 0.0, h].map(|off| adjustment.at(progress + off));
            assert!(((after - before) / (2.0 * h) - rate).norm() < 1e-7);
            assert!(((after + before - here * 2.0) / (h * h) - acceleration).norm() < 1e-4);
        }
    }
}
