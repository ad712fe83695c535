//! Where a joint is and about which axis it turns: `axis`, `origin_m`.

use config::Table;
use nalgebra::{Unit, Vector3};

/// Largest distance between two joints (m).
const LENGTH_MAX: f64 = 3.0;

/// Reads axis and origin of a joint, in the frame of what carries it.
pub(super) fn read(table: &Table) -> (Unit<Vector3<f64>>, Vector3<f64>) {
    let is_unit = |axis: &[f64; 3]| (Vector3::from(*axis).norm() - 1.0).abs() <= 1e-9;
    let axis = Vector3::from(table.numbers("axis").that(is_unit, "must be a unit vector such as [0, 1, 0]"));
    let origin = Vector3::from(table.numbers("origin_m").between(-LENGTH_MAX, LENGTH_MAX));
    (Unit::new_normalize(axis), origin)
}
