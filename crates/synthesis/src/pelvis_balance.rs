//! The semi-inverse method without a waist: the pelvis' path is found such that the ground has no horizontal moment
//! about O; the legs follow by inverse kinematics.
//!
//! The pelvis is shifted off its prescribed path, ahead and aside, by a quintic spline each. Gauss–Newton drives the
//! moments at all collocation points to zero, as for the trunk ([`balance_trunk`](crate::semi_inverse::balance_trunk));
//! the moment's derivatives by the shift are central differences. That the end mirrors the start holds exactly.

use dynamics::{NewtonEuler, Tree};
use model::{GRAVITY, JointVector, Motion};
use nalgebra::{DMatrix, Vector2, Vector3};

use crate::SynthesisError;
use crate::gauss_newton::minimise;
use crate::jet::{Jet, PointMotion};
use crate::limbs::Limbs;
use crate::spline::SplineBasis;

/// Coefficients of the spline of each direction.
const COEFFICIENTS: usize = 32;
/// Unknowns: both directions, ahead and to the left.
const UNKNOWNS: usize = 2 * COEFFICIENTS;
/// Largest change of a coefficient at which the iteration has converged (m).
const SETTLED: f64 = 1e-10;
/// Steps of the central differences: of position (m), velocity (m/s), and acceleration (m/s²).
const STEPS: [f64; 3] = [1e-5, 1e-4, 1e-3];

/// The shift of the pelvis that balances the robot.
#[derive(Clone, Debug)]
pub(crate) struct PelvisShift {
    basis: SplineBasis,
    /// Spline coefficients ahead, then to the left (m).
    coefficients: Vec<f64>,
    /// Number of Gauss–Newton steps taken.
    pub iterations: usize,
}

impl PelvisShift {
    /// The shift at a progress.
    pub(crate) fn at(&self, progress: Jet) -> PointMotion {
        let [ahead, left] = [0, 1].map(|direction| {
            let from = direction * COEFFICIENTS;
            self.basis.evaluate(&self.coefficients[from..from + COEFFICIENTS], progress)
        });
        PointMotion::new(ahead, left, Jet::default())
    }
}

/// Finds the shift of the pelvis.
///
/// # Errors
/// A leg is too short for the path, or [`SynthesisError::NotConverged`].
pub(crate) fn balance_pelvis(tree: &Tree, limbs: &Limbs) -> Result<PelvisShift, SynthesisError> {
    let basis = SplineBasis::new(COEFFICIENTS);
    let mut shift = PelvisShift { basis, coefficients: vec![0.0; UNKNOWNS], iterations: 0 };
    let mut coefficients = shift.coefficients.clone();
    let mut dynamics = NewtonEuler::default();
    shift.iterations = minimise(&mut coefficients, &end_conditions(&basis), SETTLED, |coefficients| {
        shift.coefficients.copy_from_slice(coefficients);
        let motions = limbs.motions(|progress| shift.at(progress))?;
        let residuals = motions.iter().enumerate().map(|(point, (progress, motion))| {
            let offset = moment_per_weight(&mut dynamics, tree, motion);
            let here = shift.at(*progress);
            let by_motion = slopes_by_motion(&mut dynamics, tree, limbs, point, &here, &motion.angles)?;
            Ok((offset, slopes_by_coefficient(&by_motion, &basis, *progress)))
        });
        residuals.collect()
    })?;
    shift.coefficients = coefficients;
    Ok(shift)
}

/// The ground's moment about O per weight, (−My, Mx)/(M·g) (m).
fn moment_per_weight(dynamics: &mut NewtonEuler, tree: &Tree, motion: &Motion) -> Vector2<f64> {
    let ground = dynamics.ground_wrench(tree, motion);
    Vector2::new(-ground.moment.y, ground.moment.x) / (tree.mass * GRAVITY)
}

/// Derivatives of the moment by the shift's position, velocity and acceleration, ahead and to the left.
fn slopes_by_motion(
    dynamics: &mut NewtonEuler,
    tree: &Tree,
    limbs: &Limbs,
    point: usize,
    here: &PointMotion,
    guess: &JointVector,
) -> Result<[[Vector2<f64>; 3]; 2], SynthesisError> {
    let mut slopes = [[Vector2::zeros(); 3]; 2];
    for (direction, axis) in [Vector3::x(), Vector3::y()].into_iter().enumerate() {
        for (derivative, step) in STEPS.into_iter().enumerate() {
            let mut at = |step: f64| -> Result<Vector2<f64>, SynthesisError> {
                let mut moved = *here;
                match derivative {
                    0 => moved.position += axis * step,
                    1 => moved.velocity += axis * step,
                    _ => moved.acceleration += axis * step,
                }
                Ok(moment_per_weight(dynamics, tree, &limbs.motion(point, &moved, guess)?))
            };
            slopes[direction][derivative] = (at(step)? - at(-step)?) / (2.0 * step);
        }
    }
    Ok(slopes)
}

/// Derivatives of the moment by the spline coefficients that are active at one instant.
fn slopes_by_coefficient(
    by_motion: &[[Vector2<f64>; 3]; 2],
    basis: &SplineBasis,
    progress: Jet,
) -> Vec<(usize, Vector2<f64>)> {
    let (range, functions) = basis.at(progress);
    let mut by_coefficient = Vec::new();
    for (direction, [by_position, by_velocity, by_acceleration]) in by_motion.iter().enumerate() {
        for (column, function) in range.clone().zip(&functions) {
            let slope =
                by_position * function.value + by_velocity * function.rate + by_acceleration * function.acceleration;
            by_coefficient.push((direction * COEFFICIENTS + column, slope));
        }
    }
    by_coefficient
}

/// Ahead: the end is as the start. Aside: the end is the start reversed.
fn end_conditions(basis: &SplineBasis) -> DMatrix<f64> {
    let mut conditions = DMatrix::zeros(4, UNKNOWNS);
    for (direction, sign) in [1.0, -1.0].into_iter().enumerate() {
        for (end, weight) in [(1.0, 1.0), (0.0, -sign)] {
            let (range, functions) = basis.at(Jet { value: end, rate: 1.0, acceleration: 0.0 });
            for (column, function) in range.zip(functions) {
                let column = direction * COEFFICIENTS + column;
                conditions[(2 * direction, column)] += weight * function.value;
                conditions[(2 * direction + 1, column)] += weight * function.rate;
            }
        }
    }
    conditions
}

#[cfg(test)]
mod tests {
    use config::Config;
    use model::{Joint, Mechanism};

    use crate::{Balance, LegPattern, SynthesisParameters, synthesize};

    /// The oracle: inverse dynamics of the rows; and the mirror, that the end is the start on the other foot.
    #[test]
    fn a_pelvis_balances_the_robot_with_its_trunk_upright() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
        let mechanism = Mechanism::load(file).unwrap();
        for step_length in [0.0, 0.15, 0.25] {
            let parameters =
                SynthesisParameters { step_length, balance: Balance::Pelvis, ..SynthesisParameters::default() };
            let found = synthesize(&mechanism, &LegPattern::Pendulum, &parameters, "a test").unwrap();
            assert!(found.report.residual < 1e-4, "{} m", found.report.residual);
            assert!(found.report.swap_angle < 1e-10 && found.report.swap_rate < 1e-8, "{:?}", found.report);
            for row in &found.table.rows {
                let motion = &row.motion;
                assert_eq!([motion.angles[Joint::WaistPitch], motion.angles[Joint::WaistRoll]], [0.0; 2]);
            }
        }
    }
}
