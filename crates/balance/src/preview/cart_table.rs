//! Preview control of the cart-table model (Kajita et al. 2003): where the centre of mass must go so that the ZMP follows
//! what is wanted of it over the next seconds.
//!
//! The state is position, velocity and acceleration of the centre of mass along one axis; the input is its jerk, held for a
//! knot. Optimal for the sum of `(ZMP − wanted)² + jerk_weight·jerk²`: the path is smooth (C²) whatever is wanted, and it
//! sways before the foot changes, as it must.

use nalgebra::{Matrix3, RowVector3, Vector2, Vector3};

/// Gains for one model height and knot length.
#[derive(Clone, Debug)]
pub struct CartTable {
    transition: Matrix3<f64>,
    input: Vector3<f64>,
    feedback: RowVector3<f64>,
    /// For what is wanted one, two, … knots ahead.
    preview: Vec<f64>,
}

/// Position [m], velocity [m/s] and acceleration [m/s²] of the centre of mass along one axis.
pub type CartState = Vector3<f64>;

impl CartTable {
    /// Solves for the gains.
    ///
    /// * `height_over_gravity` – z/g of the centre of mass [s²]
    /// * `knot` – time between two wanted points [s]
    /// * `knots` – how many of them are looked at
    /// * `jerk_weight` – how much a jerk costs against a ZMP error [m²/(m/s³)²]; smaller follows closer
    pub fn new(height_over_gravity: f64, knot: f64, knots: usize, jerk_weight: f64) -> Self {
        let transition = Matrix3::new(1.0, knot, knot * knot / 2.0, 0.0, 1.0, knot, 0.0, 0.0, 1.0);
        let input = Vector3::new(knot.powi(3) / 6.0, knot * knot / 2.0, knot);
        let output = RowVector3::new(1.0, 0.0, -height_over_gravity);

        // The Riccati equation, by iterating it until nothing changes any more.
        let mut cost = output.transpose() * output;
        let mut resistance = f64::INFINITY;
        let mut feedback = RowVector3::zeros();
        for _ in 0..10_000 {
            resistance = jerk_weight + input.dot(&(cost * input));
            feedback = (input.transpose() * cost * transition) / resistance;
            let next = output.transpose() * output + transition.transpose() * cost * (transition - input * feedback);
            let change = (next - cost).amax();
            cost = next;
            if change <= 1e-12 * cost.amax() {
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
        // What is wanted last is taken to last: else the plan would depend on how far the walk has come.
        let seen: f64 = preview.iter().sum();
        if let Some(last) = preview.last_mut() {
            *last += feedback[0] - seen;
        }
        Self { transition, input, feedback, preview }
    }

    /// How many knots are looked ahead.
    pub fn knots(&self) -> usize {
        self.preview.len()
    }

    /// Shares of what is wanted in the coming knots in the jerk, the next knot's first.
    pub fn gains(&self) -> &[f64] {
        &self.preview
    }

    /// The sum of values in the coming knots, each times its gain, along both axes; the next knot's value is at `next` of a
    /// ring that holds as many knots or more.
    pub fn weigh(&self, ring: &[Vector2<f64>], next: usize) -> Vector2<f64> {
        let (later, sooner) = ring.split_at(next);
        let (soon, late) = self.preview.split_at(sooner.len().min(self.knots()));
        weighted_sum(sooner, soon) + weighted_sum(later, late)
    }

    /// The state one knot later; `wanted` is the sum of what is wanted of the ZMP in the coming knots, each times its
    /// [`gain`](Self::gains).
    pub fn advance(&self, state: &CartState, wanted: f64) -> CartState {
        let jerk = wanted - (self.feedback * state)[0];
        self.transition * state + self.input * jerk
    }
}

/// In four parts, so that no addition has to wait for the one before.
fn weighted_sum(values: &[Vector2<f64>], gains: &[f64]) -> Vector2<f64> {
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

    /// Largest distance of the ZMP to a wanted point that steps from foot to foot, away from the steps themselves.
    fn worst(knots: usize) -> f64 {
        let cart = CartTable::new(HEIGHT_OVER_GRAVITY, KNOT, knots, 1e-9);
        let wanted = |knot: usize| 0.095 * if (knot / 60).is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut state = CartState::zeros();
        let mut worst: f64 = 0.0;
        for knot in 0..1200 {
            let sum = (0..knots).map(|ahead| cart.gains()[ahead] * wanted(knot + 1 + ahead)).sum();
            state = cart.advance(&state, sum);
            let zmp = state[0] - HEIGHT_OVER_GRAVITY * state[2];
            if knot > 240 && (10..50).contains(&((knot + 1) % 60)) {
                worst = worst.max((zmp - wanted(knot + 1)).abs());
            }
        }
        worst
    }

    #[test]
    fn the_zmp_follows_from_foot_to_foot() {
        assert!(worst(180) < 1e-3, "off by {} m", worst(180));
    }

    /// Far from the origin it is as near to what is wanted as at the origin.
    #[test]
    fn and_stays_where_it_is_wanted() {
        let cart = CartTable::new(HEIGHT_OVER_GRAVITY, KNOT, 180, 1e-9);
        let mut state = CartState::new(1000.0, 0.0, 0.0);
        for _ in 0..1000 {
            let sum = (0..180).map(|ahead| cart.gains()[ahead] * 1000.0).sum();
            state = cart.advance(&state, sum);
        }
        assert!((state[0] - 1000.0).abs() < 1e-6, "drifted to {} m", state[0]);
    }

    /// A ring of more knots than there are gains, wherever it begins.
    #[test]
    fn a_ring_is_weighed_from_its_next_knot_on() {
        let cart = CartTable::new(HEIGHT_OVER_GRAVITY, KNOT, 9, 1e-9);
        let value = |knot: usize| Vector2::new((knot as f64).sin(), (knot as f64).cos());
        let expected: Vector2<f64> = cart.gains().iter().enumerate().map(|(ahead, gain)| value(ahead) * *gain).sum();
        for next in 0..11 {
            let ring: Vec<_> = (0..11).map(|slot| value((slot + 11 - next) % 11)).collect();
            assert!((cart.weigh(&ring, next) - expected).amax() < 1e-12 * expected.amax(), "from {next}");
        }
    }

    #[test]
    fn and_does_not_without_looking_ahead() {
        assert!(worst(20) > 1e-2, "off by only {} m", worst(20));
    }
}
