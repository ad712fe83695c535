//! From a leg pattern to the nominal table: legs by inverse kinematics, trunk by balance, torques by inverse dynamics.

use dynamics::{NewtonEuler, Tree, zmp};
use gait::{NominalRow, NominalTable};
use model::{Joint, JointVector, Mechanism, Mirror, Mirrored, Motion, PerJoint};
use nalgebra::Vector3;

use crate::jet::PointMotion;
use crate::limbs::Limbs;
use crate::pelvis_balance::balance_pelvis;
use crate::semi_inverse::{TRUNK_JOINTS, balance_trunk};
use crate::{Balance, LegPattern, SynthesisError, SynthesisParameters};

/// A nominal half-step, with its measures.
#[derive(Clone, Debug)]
pub struct Synthesis {
    /// The nominal half-step.
    pub table: NominalTable,
    /// Measures of the half-step.
    pub report: SynthesisReport,
}

/// Measures of a synthesized half-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SynthesisReport {
    /// Largest |ZMP − O| of all rows (m).
    pub residual: f64,
    /// Number of Gauss–Newton steps.
    pub iterations: usize,
    /// Smallest and largest angle of the trunk joint that pitches, positive forward (rad).
    pub trunk_pitch: (f64, f64),
    /// Smallest and largest angle of the trunk joint that rolls, positive to the right (rad).
    pub trunk_roll: (f64, f64),
    /// Smallest knee flexion of either leg (rad).
    pub knee_flexion_min: f64,
    /// Largest difference between an angle at the end and the mirrored start (rad).
    pub swap_angle: f64,
    /// Largest difference between a rate at the end and the mirrored start (rad/s).
    pub swap_rate: f64,
}

/// Largest |ZMP − O| of a valid nominal (m).
const RESIDUAL_MAX: f64 = 1e-3;
/// Steps per unit to which angles, rates and accelerations are rounded: hides the last bits of iterated values.
const GRAINS_PER_UNIT: f64 = 1e11;
/// Collocation points per interval, so that the trunk balances between the rows as well.
const POINTS_PER_INTERVAL: usize = 2;

/// Makes a nominal half-step. `made_by` is the command, for the table's header.
///
/// # Errors
/// [`SynthesisError`] gives the reason, with row and joint, value and limit.
pub fn synthesize(
    mechanism: &Mechanism,
    pattern: &LegPattern,
    parameters: &SynthesisParameters,
    made_by: &str,
) -> Result<Synthesis, SynthesisError> {
    parameters.check()?;
    let mirror =
        Mirror::new(mechanism).ok_or_else(|| SynthesisError::NotSymmetric { mechanism: mechanism.name.clone() })?;
    let tree = Tree::new(mechanism);
    let path = pattern.path(mechanism, parameters)?;

    // legs and arms, prescribed, and the trunk or the pelvis, balancing them
    let limbs = Limbs::new(mechanism, &tree, path.as_ref(), parameters, POINTS_PER_INTERVAL);
    let (points, iterations) = match parameters.balance.of(mechanism)? {
        Balance::Trunk => {
            let mut points = limbs.motions(|_| PointMotion::AT_REST)?;
            let trunk = balance_trunk(&tree, &mirror, &points)?;
            for (progress, motion) in &mut points {
                trunk.apply(*progress, motion);
            }
            (points, trunk.iterations)
        }
        Balance::Pelvis | Balance::Auto => {
            let shift = balance_pelvis(&tree, &limbs)?;
            (limbs.motions(|progress| shift.at(progress))?, shift.iterations)
        }
    };

    // the torques and ground wrenches that the motion needs
    let mut newton_euler = NewtonEuler::default();
    let rows: Vec<NominalRow> = points
        .iter()
        .step_by(POINTS_PER_INTERVAL)
        .map(|(_, motion)| nominal_row(&mut newton_euler, &tree, &rounded(motion)))
        .collect();
    check_limits(mechanism, &rows)?;
    let report = report(mechanism, &mirror, &rows, iterations)?;

    let table = NominalTable {
        duration: parameters.duration,
        rows,
        made_by: made_by.to_owned(),
        mechanism: mechanism.body_fingerprint,
    };
    Ok(Synthesis { table, report })
}

/// Torques and ground wrench of a motion, separated into gravity part and dynamic part, whose sum is the whole.
fn nominal_row(newton_euler: &mut NewtonEuler, tree: &Tree, motion: &Motion) -> NominalRow {
    newton_euler.compute_fixed_base(tree, &Motion::at_rest(motion.angles));
    let (torque_gravity, ground_gravity) = (newton_euler.torques, newton_euler.ground);
    newton_euler.compute_with_gravity(tree, motion, 0.0);
    NominalRow {
        motion: *motion,
        torque_gravity,
        torque_dynamic: newton_euler.torques,
        ground_gravity,
        ground_dynamic: newton_euler.ground,
    }
}

/// The motion rounded to the table's grain; a zero has no sign.
fn rounded(motion: &Motion) -> Motion {
    let round = |values: &JointVector| {
        PerJoint(values.0.map(|value| (value * GRAINS_PER_UNIT).round() / GRAINS_PER_UNIT + 0.0))
    };
    Motion { angles: round(&motion.angles), rates: round(&motion.rates), accelerations: round(&motion.accelerations) }
}

/// Checks the motion against the limits of the joints.
fn check_limits(mechanism: &Mechanism, rows: &[NominalRow]) -> Result<(), SynthesisError> {
    let last = rows.len() - 1;
    for (row, NominalRow { motion, .. }) in rows.iter().enumerate() {
        for joint in Joint::ALL {
            let Some(limits) = mechanism.links[joint].limits else { continue };
            let (value, min, max) = (motion.angles[joint], limits.angle_min, limits.angle_max);
            if !(min..=max).contains(&value) {
                return Err(SynthesisError::AngleOutOfRange { row, last, joint, value, min, max });
            }
            let (value, limit) = (motion.rates[joint].abs(), limits.rate_max);
            if value > limit {
                return Err(SynthesisError::RateTooHigh { row, last, joint, value, limit });
            }
        }
    }
    Ok(())
}

/// Measures the half-step, and refuses one whose ZMP is too far from O.
fn report(
    mechanism: &Mechanism,
    mirror: &Mirror,
    rows: &[NominalRow],
    iterations: usize,
) -> Result<SynthesisReport, SynthesisError> {
    let last = rows.len() - 1;
    let mut residual = 0.0_f64;
    for (row, NominalRow { ground_gravity, ground_dynamic, .. }) in rows.iter().enumerate() {
        let value = zmp(&(*ground_gravity + *ground_dynamic)).map_or(f64::INFINITY, |zmp| zmp.norm());
        if value > RESIDUAL_MAX {
            return Err(SynthesisError::NotBalanced { row, last, value, limit: RESIDUAL_MAX });
        }
        residual = residual.max(value);
    }

    let range = |angle: &dyn Fn(&NominalRow) -> f64| {
        rows.iter()
            .map(angle)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), angle| (min.min(angle), max.max(angle)))
    };
    // The axes determine which trunk joint pitches.
    let about = |axis: Vector3<f64>| {
        range(&|row| {
            TRUNK_JOINTS.iter().map(|&joint| mechanism.links[joint].axis.dot(&axis) * row.motion.angles[joint]).sum()
        })
    };
    let knees = [Joint::RightKnee, Joint::LeftKnee];
    let (knee_flexion_min, _) =
        range(&|row| knees.map(|knee| row.motion.angles[knee].abs()).into_iter().fold(f64::INFINITY, f64::min));
    let (start, end) = (rows[0].motion.mirrored(mirror), &rows[last].motion);
    Ok(SynthesisReport {
        residual,
        iterations,
        trunk_pitch: about(Vector3::y()),
        trunk_roll: about(Vector3::x()),
        knee_flexion_min,
        swap_angle: (end.angles - start.angles).max_abs(),
        swap_rate: (end.rates - start.rates).max_abs(),
    })
}
