//! Gauss–Newton for spline coefficients: least squares under linear conditions that hold exactly.

use nalgebra::{DMatrix, DVector, Vector2};

use crate::SynthesisError;

/// Most Gauss–Newton steps.
const ITERATIONS_MAX: usize = 30;

/// A residual at one instant, with its derivatives by the coefficients that are active there.
pub(crate) type Residual = (Vector2<f64>, Vec<(usize, Vector2<f64>)>);

/// Changes the coefficients until the sum of squared residuals is least and `conditions · coefficients` is zero.
/// Returns the number of steps.
///
/// * `settled` – largest change of a coefficient at which the iteration has converged
/// * `residuals` – at all collocation points, for given coefficients
///
/// # Errors
/// Those of `residuals`, and [`SynthesisError::NotConverged`].
pub(crate) fn minimise(
    coefficients: &mut [f64],
    conditions: &DMatrix<f64>,
    settled: f64,
    mut residuals: impl FnMut(&[f64]) -> Result<Vec<Residual>, SynthesisError>,
) -> Result<usize, SynthesisError> {
    let unknowns = coefficients.len();
    let (mut iterations, mut change) = (0, f64::INFINITY);
    while iterations < ITERATIONS_MAX {
        // Minimise |r + J·δ|² under conditions·(x + δ) = 0: the Karush–Kuhn–Tucker system.
        let size = unknowns + conditions.nrows();
        let mut matrix = DMatrix::zeros(size, size);
        let mut right = DVector::zeros(size);
        for (offset, slopes) in residuals(coefficients)? {
            for &(row, slope) in &slopes {
                right[row] -= slope.dot(&offset);
                for &(column, other) in &slopes {
                    matrix[(row, column)] += slope.dot(&other);
                }
            }
        }
        for (index, condition) in conditions.row_iter().enumerate() {
            for (column, &weight) in condition.iter().enumerate() {
                matrix[(unknowns + index, column)] = weight;
                matrix[(column, unknowns + index)] = weight;
                right[unknowns + index] -= weight * coefficients[column];
            }
        }
        let Some(step) = matrix.lu().solve(&right) else { break };
        iterations += 1;
        change = 0.0;
        for (coefficient, step) in coefficients.iter_mut().zip(step.iter()) {
            *coefficient += step;
            change = change.max(step.abs());
        }
        if change < settled {
            return Ok(iterations);
        }
    }
    Err(SynthesisError::NotConverged { iterations, change })
}
