//! A table of leans over speed, turn and extension: computed once, interpolated at run time without any dynamics.

use nalgebra::Vector2;

use crate::{LeanAt, PaperLean};

/// Leans at the knots of a grid over speed `c`, turn `α` and extension `β`.
#[derive(Clone, Debug, PartialEq)]
pub struct LeanTable {
    at: LeanAt,
    knots: [Vec<f64>; 3],
    /// [rad], extension fastest, then turn, then speed.
    angles: Vec<Vector2<f64>>,
}

/// Why there can be no such table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LeanTableError {
    /// Interpolation needs an order.
    #[error("the knots of {axis} must be at least one, finite, and each greater than the one before")]
    KnotsNotIncreasing {
        /// `speed`, `turn` or `extension`.
        axis: &'static str,
    },
}

impl LeanTable {
    /// Asks `lean` for the angles of the two joints at every knot.
    ///
    /// * `speeds` – knots of `c`
    /// * `turns` – knots of `α` [rad]
    /// * `extensions` – knots of `β` [rad]
    ///
    /// # Errors
    /// When the knots of an axis are none, not finite or out of order.
    pub fn compute(
        at: LeanAt,
        speeds: &[f64],
        turns: &[f64],
        extensions: &[f64],
        mut lean: impl FnMut(f64, f64, f64) -> Vector2<f64>,
    ) -> Result<Self, LeanTableError> {
        for (axis, knots) in [("speed", speeds), ("turn", turns), ("extension", extensions)] {
            let finite = knots.iter().all(|knot| knot.is_finite());
            if knots.is_empty() || !finite || !knots.is_sorted_by(|a, b| a < b) {
                return Err(LeanTableError::KnotsNotIncreasing { axis });
            }
        }
        let mut angles = Vec::with_capacity(speeds.len() * turns.len() * extensions.len());
        for &speed in speeds {
            for &turn in turns {
                for &extension in extensions {
                    angles.push(lean(speed, turn, extension));
                }
            }
        }
        Ok(Self { at, knots: [speeds.to_vec(), turns.to_vec(), extensions.to_vec()], angles })
    }

    /// The lean for a speed `c`, turn `α` [rad] and extension `β` [rad], linear between the knots; beyond the outermost
    /// ones it is theirs. Never allocates.
    pub fn lean(&self, speed: f64, turn: f64, extension: f64) -> PaperLean {
        let [s, t, e] =
            [(0, speed), (1, turn), (2, extension)].map(|(axis, value)| Place::of(&self.knots[axis], value));
        let [_, turns, extensions] = [0, 1, 2].map(|axis: usize| self.knots[axis].len());
        let mut angles = Vector2::zeros();
        for (speed, of_speed) in s.shares() {
            for (turn, of_turn) in t.shares() {
                for (extension, of_extension) in e.shares() {
                    let knot = (speed * turns + turn) * extensions + extension;
                    angles += self.angles[knot] * (of_speed * of_turn * of_extension);
                }
            }
        }
        PaperLean { at: self.at, angles }
    }
}

/// Between two knots.
struct Place {
    before: usize,
    after: usize,
    /// How far from the one to the other, 0 to 1.
    share: f64,
}

impl Place {
    fn of(knots: &[f64], value: f64) -> Self {
        let after = knots.partition_point(|knot| *knot <= value).min(knots.len() - 1);
        let before = after.saturating_sub(1);
        let span = knots[after] - knots[before];
        let share = if span > 0.0 { ((value - knots[before]) / span).clamp(0.0, 1.0) } else { 0.0 };
        Self { before, after, share }
    }

    fn shares(&self) -> [(usize, f64); 2] {
        [(self.before, 1.0 - self.share), (self.after, self.share)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function that is linear in each variable is its own interpolant.
    #[test]
    fn what_is_linear_in_each_variable_is_met_exactly() {
        let lean = |c: f64, a: f64, b: f64| Vector2::new(1.0 + c * a - b, c * a * b + 2.0 * a);
        let table = LeanTable::compute(LeanAt::Ankle, &[0.6, 1.0, 1.4], &[-0.4, 0.4], &[-0.1, 0.0, 0.1], lean).unwrap();
        for (c, a, b) in [(0.6, -0.4, -0.1), (0.75, 0.1, 0.03), (1.4, 0.4, 0.1), (1.39, -0.39, 0.0)] {
            assert!((table.lean(c, a, b).angles - lean(c, a, b)).norm() < 1e-14);
        }
        assert!((table.lean(9.0, 9.0, -9.0).angles - lean(1.4, 0.4, -0.1)).norm() < 1e-14);
    }

    #[test]
    fn one_knot_is_the_same_everywhere() {
        let table =
            LeanTable::compute(LeanAt::Trunk, &[1.0], &[0.0], &[0.0], |_, _, _| Vector2::new(0.1, 0.2)).unwrap();
        assert_eq!(table.lean(0.3, 1.0, -1.0), PaperLean { at: LeanAt::Trunk, angles: Vector2::new(0.1, 0.2) });
    }

    #[test]
    fn knots_out_of_order_are_refused() {
        let none = |_: f64, _: f64, _: f64| Vector2::zeros();
        for turns in [vec![], vec![0.1, 0.1], vec![0.0, f64::NAN]] {
            let error = LeanTable::compute(LeanAt::Ankle, &[1.0], &turns, &[0.0], none).unwrap_err();
            assert_eq!(error, LeanTableError::KnotsNotIncreasing { axis: "turn" });
        }
    }
}
