//! Where the swinging foot lands otherwise than the walk asks: a step after a push (Englsberger, Ott and Albu-Schäffer
//! 2015; Griffin et al. 2017 adjust steps by the error of the divergent component expected at touchdown, too).

use nalgebra::Vector2;

/// The shift of the swinging sole over a half-step: a quintic from where it is to where it is wanted, anew whenever that
/// changes, so that the sole's acceleration is continuous and it lands at rest.
#[derive(Clone, Copy, Debug, Default)]
pub struct LandingShift {
    /// Of the polynomial over the rest of the half-step [m].
    coefficients: [Vector2<f64>; 6],
    /// Progress at which it begins.
    since: f64,
    /// At the landing [m].
    target: Vector2<f64>,
}

/// Progress at which the sole is over its place.
const OVER_PLACE: f64 = 0.95;
/// Progress after which the place is not changed any more.
const DECIDED: f64 = 0.75;

impl LandingShift {
    /// Where the foot lands, off where the walk asks it to [m].
    pub fn target(&self) -> Vector2<f64> {
        self.target
    }

    /// Whether there is time to land elsewhere.
    pub fn is_in_time(progress: f64) -> bool {
        progress <= DECIDED
    }

    /// Lands elsewhere, while [`is_in_time`](Self::is_in_time).
    pub fn retarget(&mut self, progress: f64, target: Vector2<f64>) {
        let [value, rate, acceleration] = self.at(progress);
        let span = OVER_PLACE - progress;
        let (rate, acceleration, way) = (rate * span, acceleration * (span * span), target - value);
        self.coefficients = [
            value,
            rate,
            acceleration / 2.0,
            way * 10.0 - rate * 6.0 - acceleration * 1.5,
            way * -15.0 + rate * 8.0 + acceleration * 1.5,
            way * 6.0 - rate * 3.0 - acceleration * 0.5,
        ];
        self.since = progress;
        self.target = target;
    }

    /// The shift at a progress [m], with its first and second derivative by the progress.
    pub fn at(&self, progress: f64) -> [Vector2<f64>; 3] {
        if progress >= OVER_PLACE {
            return [self.target, Vector2::zeros(), Vector2::zeros()];
        }
        let span = OVER_PLACE - self.since;
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

    /// Retargeted twice: value, rate and acceleration are the same on both sides of it, and it lands at rest.
    #[test]
    fn it_goes_smoothly_to_where_it_is_wanted_last() {
        let mut shift = LandingShift::default();
        for (progress, target) in [(0.2, Vector2::new(0.1, -0.03)), (0.55, Vector2::new(-0.02, 0.05))] {
            let before = shift.at(progress);
            assert!(LandingShift::is_in_time(progress));
            shift.retarget(progress, target);
            let after = shift.at(progress);
            for (before, after) in before.iter().zip(after) {
                assert!((before - after).norm() < 1e-12 * (1.0 + before.norm()), "{before} {after}");
            }
            let [end, rate, acceleration] = shift.at(OVER_PLACE - 1e-9);
            assert!((end - target).norm() < 1e-9 && rate.norm() < 1e-6 && acceleration.norm() < 1e-4);
        }
        assert!(!LandingShift::is_in_time(0.8));
        assert_eq!(shift.at(1.0)[0], Vector2::new(-0.02, 0.05));
    }

    /// The oracle: derivatives by differences.
    #[test]
    fn its_derivatives_are_those_of_its_values() {
        let mut shift = LandingShift::default();
        shift.retarget(0.1, Vector2::new(0.1, -0.03));
        shift.retarget(0.4, Vector2::new(0.05, 0.02));
        let h = 1e-5;
        for progress in [0.45, 0.6, 0.85] {
            let [[before, ..], [here, rate, acceleration], [after, ..]] =
                [-h, 0.0, h].map(|off| shift.at(progress + off));
            assert!(((after - before) / (2.0 * h) - rate).norm() < 1e-7);
            assert!(((after + before - here * 2.0) / (h * h) - acceleration).norm() < 1e-4);
        }
    }
}
