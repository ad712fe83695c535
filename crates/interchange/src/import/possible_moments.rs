//! Moments of inertia that a rigid body can have: each positive, and at most the sum of the other two.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use crate::import::biped::{Biped, Segment};
use crate::import::body::LumpedBody;

/// Least radius of gyration of a body, as a share of the leg's length: some URDFs give mass without inertia.
const GYRATION_MIN: f64 = 0.005;
/// A smaller moment is none (kg·m²).
const MOMENT_MIN: f64 = 1e-11;
/// By how much the greatest moment may exceed the others' sum, as a share of it.
const ROUNDING: f64 = 1e-9;

/// Raises moments of inertia that no body can have to such as one can have, and tells which; `leg` is the length of the
/// leg (m).
pub(super) fn repair(biped: &mut Biped, leg: f64, lines: &mut Vec<String>) {
    let mut changed = Vec::new();
    let Biped { legs, pelvis, middle, trunk, arms, .. } = biped;
    for (body, name) in [(pelvis, "pelvis"), (middle, "waist"), (trunk, "trunk")] {
        changed.extend(repair_body(body, leg).map(|words| format!("{name} {words}")));
    }
    let mut pairs = |right: &mut [Segment], left: &mut [Segment], names: &[&str]| {
        for ((right, left), name) in right.iter_mut().zip(left).zip(names) {
            changed.extend(repair_body(&mut right.body, leg).map(|words| format!("{name} {words}")));
            left.body = right.body.mirrored();
        }
    };
    let [right, left] = legs;
    pairs(right, left, &["first hip link", "second hip link", "thigh", "shank", "ankle", "foot"]);
    let [right, left] = arms;
    pairs(right, left, &["upper arm", "forearm"]);
    if !changed.is_empty() {
        lines.push(format!(
            "moments of inertia that no body can have (each must be positive, and at most the sum of the other two) \
             were raised: {}",
            changed.join("; ")
        ));
    }
}

/// Whether a body can have this inertia about its centre of mass (kg·m²).
pub(super) fn has_possible_moments(inertia: &Matrix3<f64>) -> bool {
    let moments = inertia.symmetric_eigenvalues();
    moments.iter().all(|moment| *moment > MOMENT_MIN && 2.0 * moment <= moments.sum() + ROUNDING * moment)
}

/// Raises the moments of one body; in words what they were and became.
pub(super) fn repair_body(body: &mut LumpedBody, leg: f64) -> Option<String> {
    if body.mass <= 0.0 {
        return None;
    }
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(body.inertia);
    let least = body.mass * (GYRATION_MIN * leg).powi(2);
    let mut moments = eigenvalues.map(|moment| if moment > 0.0 { moment } else { least });
    let greatest = moments.imax();
    let lacking = 2.0 * moments[greatest] - moments.sum();
    if lacking > ROUNDING * moments[greatest] {
        // The others share what lacks, and some rounding.
        let share = 0.5 * lacking + ROUNDING * moments[greatest];
        let add = Vector3::from_fn(|axis, _| if axis == greatest { 0.0 } else { share });
        moments += add;
    } else if moments == eigenvalues {
        return None;
    }
    body.inertia = eigenvectors * Matrix3::from_diagonal(&moments) * eigenvectors.transpose();
    let words = |moments: Vector3<f64>| format!("[{:.3e}, {:.3e}, {:.3e}]", moments[0], moments[1], moments[2]);
    Some(format!("{} to {} kg·m²", words(eigenvalues), words(moments)))
}
