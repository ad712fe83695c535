//! Quintic B-splines on equal intervals: four continuous derivatives.

use std::ops::Range;

use crate::jet::Jet;

/// Number of polynomial pieces of a basis function.
const SPAN: usize = 6;

/// The basis of splines with a given number of coefficients over progress 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SplineBasis {
    /// Number of polynomial pieces of a spline.
    pieces: usize,
}

impl SplineBasis {
    /// The basis for splines with this number of coefficients.
    ///
    /// # Panics
    /// With fewer than six coefficients.
    pub(crate) fn new(coefficients: usize) -> Self {
        assert!(coefficients >= SPAN, "a quintic spline has at least {SPAN} coefficients");
        Self { pieces: coefficients - SPAN + 1 }
    }

    /// The coefficients whose basis functions are not zero at a progress, and the values of these functions there.
    pub(crate) fn at(&self, progress: Jet) -> (Range<usize>, [Jet; SPAN]) {
        let position = progress * self.pieces as f64;
        // The end belongs to the last piece.
        let piece = (position.value as usize).min(self.pieces - 1);
        let values = std::array::from_fn(|index| basis_function(position - piece as f64 + (SPAN - 1 - index) as f64));
        (piece..piece + SPAN, values)
    }

    /// The value of the spline with the given coefficients at a progress.
    pub(crate) fn evaluate(&self, coefficients: &[f64], progress: Jet) -> Jet {
        let (range, values) = self.at(progress);
        coefficients[range]
            .iter()
            .zip(values)
            .fold(Jet::default(), |sum, (&coefficient, value)| sum + value * coefficient)
    }
}

/// The cardinal quintic B-spline, which is not zero between 0 and 6 (Schoenberg 1946).
fn basis_function(position: Jet) -> Jet {
    // Truncated powers lose digits on the far half: use the symmetry.
    let near = if position.value > 3.0 { -position + 6.0 } else { position };
    let mut sum = Jet::default();
    for (knot, weight) in [(0.0, 1.0), (1.0, -6.0), (2.0, 15.0)] {
        let ahead = near - knot;
        if ahead.value > 0.0 {
            let square = ahead * ahead;
            sum = sum + square * square * ahead * (weight / 120.0);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::SplineBasis;
    use crate::jet::Jet;

    fn at(progress: f64) -> Jet {
        Jet { value: progress, rate: 1.0, acceleration: 0.0 }
    }

    #[test]
    fn spline_basis_functions_add_up_to_one() {
        let basis = SplineBasis::new(14);
        for step in 0..=100 {
            let one = basis.evaluate(&[1.0; 14], at(f64::from(step) / 100.0));
            assert!((one.value - 1.0).abs() < 1e-14 && one.rate.abs() < 1e-12 && one.acceleration.abs() < 1e-10);
        }
    }

    /// Oracle: coefficients at the Greville points reproduce a straight line.
    #[test]
    fn splines_reproduce_straight_lines() {
        let basis = SplineBasis::new(14);
        let coefficients: Vec<f64> = (0..14).map(|index| (f64::from(index) - 2.0) / 9.0).collect();
        for step in 0..=100 {
            let progress = f64::from(step) / 100.0;
            let line = basis.evaluate(&coefficients, at(progress));
            assert!((line.value - progress).abs() < 1e-13 && (line.rate - 1.0).abs() < 1e-12);
        }
    }
}
