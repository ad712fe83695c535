//! Preview control of the cart-table model (Kajita et al. 2003): the centre of mass whose ZMP tracks a reference that
//! is known over the coming seconds.
//!
//! The state is position, velocity and acceleration of the centre of mass along one axis; the input is its jerk,
//! constant between knots. The control minimises the sum of `(ZMP − reference)² + jerk_weight·jerk²`. The centre of
//! mass is twice continuously differentiable whatever the reference, and moves before the support foot changes, as it
//! must.

use nalgebra::{Matrix3, RowVector3, Vector2, Vector3};

/// The gains of preview control for one height of the centre of mass and one distance of knots.
#[derive(Clone, Debug)]
pub(crate) struct PreviewController {
    transition: Matrix3<f64>,
    input: Vector3<f64>,
    feedback: RowVector3<f64>,
    /// Gains of the references one, two, … knots ahead.
    preview: Vec<f64>,
}

/// Position (m), velocity (m/s) and acceleration (m/s²) of the centre of mass along one axis.
pub(crate) type CartState = Vector3<f64>;

/// Rounds of the Riccati iteration at most; it converges within a few hundred.
const RICCATI_ROUNDS_MAX: usize = 10_000;
/// Relative change of the cost at which the Riccati iteration ends.
const RICCATI_TOLERANCE: f64 = 1e-12;

impl PreviewController {
    /// Solves for the gains.
    ///
    /// * `height_over_gravity` – z/g of the centre of mass (s²)
    /// * `knot` – time between knots (s)
    /// * `knots` – how many coming knots have a reference
    /// * `jerk_weight` – cost of a jerk against a ZMP error (m²/(m/s³)²); smaller tracks closer
    pub(crate) fn new(height_over_gravity: f64, knot: f64, knots: usize, jerk_weight: f64) -> Self {
        let transition = Matrix3::new(1.0, knot, knot * knot / 2.0, 0.0, 1.0, knot, 0.0, 0.0, 1.0);
        let input = Vector3::new(knot.powi(3) / 6.0, knot * knot / 2.0, knot);
        let output = RowVector3::new(1.0, 0.0, -height_over_gravity);

        // The discrete algebraic Riccati equation, by iterating it until nothing changes any more.
        let mut cost = output.transpose() * output;
        let mut resistance = f64::INFINITY;
        let mut feedback = RowVector3::zeros();
        for _ in 0..RICCATI_ROUNDS_MAX {
            resistance = jerk_weight + input.dot(&(cost * input));
            feedback = (input.transpose() * cost * transition) / resistance;
            let next = output.transpose() * output + transition.transpose() * cost * (transition - input * feedback);
            let change = (next - cost).amax();
            cost = next;
            if change <= RICCATI_TOLERANCE * cost.amax() {
                break;
            }
        }

        let closed = (transition - input * feedback).transpose();
        let mut carried = output.transpose();
        let mut preview: Vec<f64> = (0..knots)
            .map(|_| {
                let gain = input.dot(&carried) / resistance;
                carried = closed * carried;
                gain
            })
            .collect();
        // The last reference is taken to hold for ever: otherwise the plan would depend on the distance walked.
        let sum: f64 = preview.iter().sum();
        if let Some(last) = preview.last_mut() {
            *last += feedback[0] - sum;
        }
        Self { transition, input, feedback, preview }
    }

    /// How many coming knots have a reference.
    pub(crate) fn knots(&self) -> usize {
        self.preview.len()
    }

    /// The sum of the references of the coming knots, each times its preview gain, along both axes.
    ///
    /// * `ring` – references of as many knots or more
    /// * `next` – where in it the next knot's is
    pub(crate) fn weighted_sum(&self, ring: &[Vector2<f64>], next: usize) -> Vector2<f64> {
        let (later, sooner) = ring.split_at(next);
        let (soon, late) = self.preview.split_at(sooner.len().min(self.knots()));
        dot(sooner, soon) + dot(later, late)
    }

    /// The state one knot later.
    ///
    /// * `weighted_sum` – of the references of the coming knots, see [`weighted_sum`](Self::weighted_sum)
    pub(crate) fn advance(&self, state: &CartState, weighted_sum: f64) -> CartState {
        let jerk = weighted_sum - (self.feedback * state)[0];
        self.transition * state + self.input * jerk
    }
}

/// The sum of values, each times its gain; in four parts, so that no addition has to wait for the one before.
fn dot(values: &[Vector2<f64>], gains: &[f64]) -> Vector2<f64> {
    let count = values.len().min(gains.len());
    let ((values, last_values), (gains, last_gains)) =
        (values[..count].as_chunks::<4>(), gains[..count].as_chunks::<4>());
    let mut sums = [Vector2::zeros(); 4];
    for (values, gains) in values.iter().zip(gains) {
        for part in 0..4 {
            sums[part] += values[part] * gains[part];
        }
    }
    let rest: Vector2<f64> = last_values.iter().zip(last_gains).map(|(value, gain)| value * *gain).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEIGHT_OVER_GRAVITY: f64 = 0.0976;
    const KNOT: f64 = 0.01;

    /// Largest distance of the ZMP to a reference that steps from foot to foot, away from the steps themselves.
    fn largest_error(knots: usize) -> f64 {
        let controller = PreviewController::new(HEIGHT_OVER_GRAVITY, KNOT, knots, 1e-9);
        let reference = |knot: usize| 0.095 * if (knot / 60).is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut state = CartState::zeros();
        let mut worst: f64 = 0.0;
        for knot in 0..1200 {
            let sum = (0..knots).map(|ahead| controller.preview[ahead] * reference(knot + 1 + ahead)).sum();
            state = controller.advance(&state, sum);
            let zmp = state[0] - HEIGHT_OVER_GRAVITY * state[2];
            if knot > 240 && (10..50).contains(&((knot + 1) % 60)) {
                worst = worst.max((zmp - reference(knot + 1)).abs());
            }
        }
        worst
    }

    #[test]
    fn zmp_follows_a_reference_from_foot_to_foot() {
        assert!(largest_error(180) < 1e-3, "off by {} m", largest_error(180));
    }

    #[test]
    fn zmp_does_not_follow_without_preview() {
        assert!(largest_error(20) > 1e-2, "off by only {} m", largest_error(20));
    }

    #[test]
    fn centre_of_mass_rests_over_a_constant_reference_far_from_the_origin() {
        let controller = PreviewController::new(HEIGHT_OVER_GRAVITY, KNOT, 180, 1e-9);
        let mut state = CartState::new(1000.0, 0.0, 0.0);
        for _ in 0..1000 {
            let sum = (0..180).map(|ahead| controller.preview[ahead] * 1000.0).sum();
            state = controller.advance(&state, sum);
        }
        assert!((state[0] - 1000.0).abs() < 1e-6, "drifted to {} m", state[0]);
    }

    /// A ring of more knots than there are gains, wherever it begins.
    #[test]
    fn weighted_sum_begins_at_the_next_knot_of_a_ring() {
        let controller = PreviewController::new(HEIGHT_OVER_GRAVITY, KNOT, 9, 1e-9);
        let value = |knot: usize| Vector2::new((knot as f64).sin(), (knot as f64).cos());
        let expected: Vector2<f64> =
            controller.preview.iter().enumerate().map(|(ahead, gain)| value(ahead) * *gain).sum();
        for next in 0..11 {
            let ring: Vec<_> = (0..11).map(|slot| value((slot + 11 - next) % 11)).collect();
            let found = controller.weighted_sum(&ring, next);
            assert!((found - expected).amax() < 1e-12 * expected.amax(), "from {next}");
        }
    }
}
