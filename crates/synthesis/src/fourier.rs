//! Periodic samples as a Fourier series, by least squares.

use nalgebra::{DMatrix, DVector};

use crate::jet::Jet;

/// A periodic function over a cycle from 0 to 1.
#[derive(Clone, Debug)]
pub(crate) struct FourierSeries {
    /// Constant, then cosine and sine of each harmonic.
    coefficients: DVector<f64>,
}

/// Harmonics kept: the legs of walking people need no more (Winter 1990 cuts gait off at the sixth).
const HARMONICS: usize = 6;
/// Coefficients of a series; there must be more samples than that.
pub(crate) const COEFFICIENTS: usize = 1 + 2 * HARMONICS;

impl FourierSeries {
    /// The best series through samples `(cycle, value)`; `None` when they do not determine one.
    pub(crate) fn fit(samples: &[(f64, f64)]) -> Option<Self> {
        let mut normal = DMatrix::zeros(COEFFICIENTS, COEFFICIENTS);
        let mut moments = DVector::zeros(COEFFICIENTS);
        for &(cycle, value) in samples {
            let basis = basis(Jet::constant(cycle)).map(|jet| jet.value);
            for (row, &left) in basis.iter().enumerate() {
                moments[row] += left * value;
                for (column, &right) in basis.iter().enumerate() {
                    normal[(row, column)] += left * right;
                }
            }
        }
        let coefficients = normal.cholesky()?.solve(&moments);
        Some(Self { coefficients })
    }

    /// The value at a point of the cycle, with derivatives.
    pub(crate) fn at(&self, cycle: Jet) -> Jet {
        basis(cycle)
            .into_iter()
            .zip(self.coefficients.iter())
            .fold(Jet::default(), |sum, (function, &coefficient)| sum + function * coefficient)
    }
}

/// The functions of the series at a point of the cycle.
fn basis(cycle: Jet) -> [Jet; COEFFICIENTS] {
    std::array::from_fn(|index| {
        let angle = cycle * (std::f64::consts::TAU * index.div_ceil(2) as f64);
        if index % 2 == 1 { angle.sin() } else { angle.cos() }
    })
}

#[cfg(test)]
mod tests {
    use super::FourierSeries;
    use crate::jet::Jet;

    #[test]
    fn a_fourier_series_is_recovered_from_its_samples() {
        let f = |cycle: f64| {
            0.3 + 0.2 * (std::f64::consts::TAU * cycle).cos() - (3.0 * std::f64::consts::TAU * cycle).sin()
        };
        let samples: Vec<_> = (0..25).map(|i| (f64::from(i) * 0.04, f(f64::from(i) * 0.04))).collect();
        let series = FourierSeries::fit(&samples).expect("enough samples");
        for cycle in [0.013, 0.5, 0.77] {
            assert!((series.at(Jet::constant(cycle)).value - f(cycle)).abs() < 1e-12);
        }
    }

    #[test]
    fn fourier_series_are_not_determined_by_too_few_samples() {
        assert!(FourierSeries::fit(&[(0.0, 1.0), (0.5, 2.0)]).is_none());
    }
}
