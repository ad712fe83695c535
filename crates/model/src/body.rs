//! Mass and inertia of rigid bodies.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};

/// Mass and inertia of a rigid body, in the link's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Mass of the body (kg).
    pub mass: f64,
    /// Centre of mass in the link's frame (m).
    pub com: Vector3<f64>,
    /// Principal moments of inertia about the centre of mass (kg·m²).
    pub inertia: Vector3<f64>,
    /// Orientation of the principal axes: maps their coordinates to the link's. `None` where they are the link's axes.
    pub principal_axes: Option<Rotation3<f64>>,
}

impl Body {
    /// The body of a massless link.
    pub const NONE: Body = Body {
        mass: 0.0,
        com: Vector3::new(0.0, 0.0, 0.0),
        inertia: Vector3::new(0.0, 0.0, 0.0),
        principal_axes: None,
    };

    /// The body with an inertia given as a matrix, about the centre of mass in the link's frame (kg·m²). Its moments
    /// are NaN if a number is not finite.
    pub fn with_matrix(mass: f64, com: Vector3<f64>, matrix: &Matrix3<f64>) -> Self {
        if matrix.iter().any(|entry| !entry.is_finite()) {
            let inertia = Vector3::repeat(f64::NAN);
            return Self { mass, com, inertia, principal_axes: Some(Rotation3::identity()) };
        }
        let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(*matrix);
        let right_handed = if eigenvectors.determinant() < 0.0 { -eigenvectors } else { eigenvectors };
        Self { mass, com, inertia: eigenvalues, principal_axes: Some(Rotation3::from_matrix_unchecked(right_handed)) }
    }

    /// Inertia about the centre of mass as a matrix, in the link's frame (kg·m²).
    pub fn inertia_matrix(&self) -> Matrix3<f64> {
        let principal = Matrix3::from_diagonal(&self.inertia);
        self.principal_axes.map_or(principal, |axes| axes.matrix() * principal * axes.matrix().transpose())
    }

    /// Rotation of the principal axes, given that of the link: both map to the same frame.
    #[inline(always)]
    pub fn principal_rotation(&self, link: &Matrix3<f64>) -> Matrix3<f64> {
        match &self.principal_axes {
            None => *link,
            Some(axes) => link * axes.matrix(),
        }
    }
}
