//! Mass and inertia of a link: `mass_kg`, `com_m`, `inertia_kg_m2`.

use config::Table;
use nalgebra::{Matrix3, Vector3};

use crate::Body;

/// Largest distance of a centre of mass from its joint (m).
const COM_MAX: f64 = 3.0;
/// Smallest and largest mass of a link (kg).
const MASS: (f64, f64) = (1e-6, 1000.0);
/// Smallest and largest moment of inertia of a link (kg·m²).
const MOMENT_MIN: f64 = 1e-12;
const MOMENT_MAX: f64 = 1000.0;
/// Rounding of moments, as a share of their sum: a body may be flat.
const ROUNDING: f64 = 1e-9;

/// Reads a body; none of the keys is a massless link.
///
/// `inertia_kg_m2` has the three moments along the link's axes, or these and the products xy, xz, yz, which are the
/// entries of the matrix, about the centre of mass.
pub(super) fn read(table: &Table) -> Body {
    let keys = ["mass_kg", "com_m", "inertia_kg_m2"].map(|key| table.has(key));
    if keys == [false; 3] {
        return Body::NONE;
    }
    let mass = table.number("mass_kg").between(MASS.0, MASS.1);
    let com = table.numbers("com_m").between(-COM_MAX, COM_MAX).into();
    let must = format!(
        "must be three moments, and maybe the products xy, xz, yz: principal moments between {MOMENT_MIN} and \
         {MOMENT_MAX}, each at most the sum of the other two"
    );
    if table.array_len("inertia_kg_m2") == Some(6) {
        let with = |entries: &[f64; 6]| Body::with_matrix(mass, com, &matrix(entries));
        let written = table.numbers::<6>("inertia_kg_m2").that(|entries| is_possible(&with(entries).inertia), &must);
        return with(&written);
    }
    let inertia = table.numbers("inertia_kg_m2").that(|moments| is_possible(&Vector3::from(*moments)), &must).into();
    Body { mass, com, inertia, principal_axes: None }
}

/// Whether a rigid body has these principal moments.
pub(super) fn is_possible(moments: &Vector3<f64>) -> bool {
    let sum = moments.sum();
    moments.iter().all(|moment| {
        (MOMENT_MIN..=MOMENT_MAX).contains(moment) && *moment <= (sum - moment) * (1.0 + ROUNDING) + ROUNDING * sum
    })
}

/// The matrix with the moments xx, yy, zz and the products xy, xz, yz.
fn matrix([xx, yy, zz, xy, xz, yz]: &[f64; 6]) -> Matrix3<f64> {
    Matrix3::new(*xx, *xy, *xz, *xy, *yy, *yz, *xz, *yz, *zz)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The oracle: the matrix itself.
    #[test]
    fn principal_moments_along_principal_axes_are_the_matrix() {
        let entries = [0.05, 0.07, 0.04, 0.004, -0.011, 0.002];
        let with = |entries: &[f64; 6]| Body::with_matrix(1.0, Vector3::zeros(), &matrix(entries));
        let body = with(&entries);
        assert!((body.principal_axes.expect("they are turned").matrix().determinant() - 1.0).abs() < 1e-12);
        let matrix = body.inertia_matrix();
        let found = [matrix.m11, matrix.m22, matrix.m33, matrix.m12, matrix.m13, matrix.m23].into_iter().zip(entries);
        assert!(found.into_iter().all(|(found, entry)| (found - entry).abs() < 1e-15));
        assert!(is_possible(&body.inertia));
        assert!(!is_possible(&with(&[0.05, 0.07, 0.04, 0.06, 0.0, 0.0]).inertia));
    }
}
