//! The semi-inverse method (Vukobratović and Stokić 1975; DESIGN §3): given the legs and arms, the two trunk joints
//! such that the ground has no horizontal moment about O.
//!
//! Each trunk joint is a quintic spline. Gauss–Newton drives the moments at all collocation points to zero in the least
//! squares sense; that the end mirrors the start, in angle and rate, is linear in the coefficients and holds exactly.

use dynamics::{Tree, ZmpJacobian};
use model::{Joint, Mirror, Motion};
use nalgebra::{DMatrix, Vector2};

use crate::SynthesisError;
use crate::gauss_newton::minimise;
use crate::jet::Jet;
use crate::spline::SplineBasis;

/// The joints between pelvis and trunk; the mirror maps each to itself.
pub(crate) const TRUNK_JOINTS: [Joint; 2] = [Joint::WaistPitch, Joint::WaistRoll];

/// Coefficients of each trunk joint's spline: for a recorded gait 14 leave the ZMP up to 2 mm from O, 32 a few
/// hundredths of that.
const COEFFICIENTS: usize = 32;
/// Largest change of a coefficient at which the iteration has converged (rad).
const SETTLED: f64 = 1e-11;

/// The motion of the trunk that balances the robot.
#[derive(Clone, Debug)]
pub(crate) struct TrunkMotion {
    basis: SplineBasis,
    /// Spline coefficients of both joints, one after the other (rad).
    coefficients: Vec<f64>,
    /// Number of Gauss–Newton steps taken.
    pub iterations: usize,
}

impl TrunkMotion {
    /// Writes the motion of the trunk joints into `motion`.
    pub(crate) fn apply(&self, progress: Jet, motion: &mut Motion) {
        for (joint, coefficients) in TRUNK_JOINTS.into_iter().zip(self.coefficients.chunks(COEFFICIENTS)) {
            let Jet { value, rate, acceleration } = self.basis.evaluate(coefficients, progress);
            motion.angles[joint] = value;
            motion.rates[joint] = rate;
            motion.accelerations[joint] = acceleration;
        }
    }
}

/// Finds the motion of the trunk, given the motion of all other joints at the collocation points.
///
/// # Errors
/// [`SynthesisError::NotConverged`] when the iteration does not converge.
pub(crate) fn balance_trunk(
    tree: &Tree,
    mirror: &Mirror,
    points: &[(Jet, Motion)],
) -> Result<TrunkMotion, SynthesisError> {
    let basis = SplineBasis::new(COEFFICIENTS);
    let unknowns = TRUNK_JOINTS.len() * COEFFICIENTS;
    let mut trunk = TrunkMotion { basis, coefficients: vec![0.0; unknowns], iterations: 0 };
    let mut coefficients = trunk.coefficients.clone();
    let mut moments = ZmpJacobian::default();
    trunk.iterations = minimise(&mut coefficients, &end_conditions(&basis, mirror), SETTLED, |coefficients| {
        trunk.coefficients.copy_from_slice(coefficients);
        let residuals = points.iter().map(|(progress, motion)| {
            let mut motion = *motion;
            trunk.apply(*progress, &mut motion);
            let offset = moments.moment_per_weight(tree, &motion);
            (offset, slopes_by_coefficient(&moments, &basis, *progress))
        });
        Ok(residuals.collect())
    })?;
    trunk.coefficients = coefficients;
    Ok(trunk)
}

/// For each trunk joint, angle and rate: (end − sign·start)·coefficients = 0.
fn end_conditions(basis: &SplineBasis, mirror: &Mirror) -> DMatrix<f64> {
    let mut conditions = DMatrix::zeros(2 * TRUNK_JOINTS.len(), TRUNK_JOINTS.len() * COEFFICIENTS);
    for (position, joint) in TRUNK_JOINTS.into_iter().enumerate() {
        for (end, sign) in [(1.0, 1.0), (0.0, -mirror.sign(joint))] {
            let (range, functions) = basis.at(Jet { value: end, rate: 1.0, acceleration: 0.0 });
            for (column, function) in range.zip(functions) {
                let column = position * COEFFICIENTS + column;
                conditions[(2 * position, column)] += sign * function.value;
                conditions[(2 * position + 1, column)] += sign * function.rate;
            }
        }
    }
    conditions
}

/// Derivatives of the ground's moment per weight by the spline coefficients that are active at one instant.
fn slopes_by_coefficient(moments: &ZmpJacobian, basis: &SplineBasis, progress: Jet) -> Vec<(usize, Vector2<f64>)> {
    let (range, functions) = basis.at(progress);
    let mut by_coefficient = Vec::new();
    for (position, joint) in TRUNK_JOINTS.into_iter().enumerate() {
        for (column, function) in range.clone().zip(&functions) {
            let slope = moments.by_angle[joint] * function.value
                + moments.by_rate[joint] * function.rate
                + moments.by_acceleration[joint] * function.acceleration;
            by_coefficient.push((position * COEFFICIENTS + column, slope));
        }
    }
    by_coefficient
}
