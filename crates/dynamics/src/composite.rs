//! Composite rigid bodies: the inertia of the links beyond a joint as one body, about the common origin.

use model::{Joint, Wrench};
use nalgebra::{Matrix3, Vector3};

use crate::twist::Twist;
use crate::{Kinematics, Tree};

/// Mass, first and second moment of rigid bodies that move as one, in world axes about the common origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Composite {
    /// Mass of the bodies (kg).
    pub mass: f64,
    /// Mass times centre of mass (kg·m).
    pub first: Vector3<f64>,
    /// Rotational inertia (kg·m²).
    pub second: Matrix3<f64>,
}

impl Composite {
    pub(crate) const ZERO: Composite = Composite {
        mass: 0.0,
        first: Vector3::new(0.0, 0.0, 0.0),
        second: Matrix3::new(0., 0., 0., 0., 0., 0., 0., 0., 0.),
    };

    /// The body of one link.
    #[inline(always)]
    pub(crate) fn of_link(tree: &Tree, kinematics: &Kinematics, joint: Joint) -> Self {
        let Some(body) = &tree.nodes[joint].body else { return Self::ZERO };
        let rotation = &kinematics.rotation[joint];
        let com = kinematics.origin[joint] + rotation * body.com;
        let principal = body.principal_rotation(rotation);
        let about_com = principal * Matrix3::from_diagonal(&body.inertia) * principal.transpose();
        let first = body.mass * com;
        let about_origin = Matrix3::from_diagonal_element(first.dot(&com)) - first * com.transpose();
        Self { mass: body.mass, first, second: about_com + about_origin }
    }

    /// Inertia times a motion field: the momentum for a field of velocities, the wrench for one of accelerations.
    #[inline(always)]
    pub(crate) fn times(&self, field: &Twist) -> Wrench {
        Wrench {
            force: self.mass * field.linear + field.angular.cross(&self.first),
            moment: self.second * field.angular + self.first.cross(&field.linear),
        }
    }
}

impl std::ops::Add for Composite {
    type Output = Composite;

    #[inline(always)]
    fn add(self, other: Composite) -> Composite {
        Composite { mass: self.mass + other.mass, first: self.first + other.first, second: self.second + other.second }
    }
}
