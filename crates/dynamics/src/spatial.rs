//! Spatial vectors: (angular, linear), in world axes about one common origin (Featherstone 2008, chapter 2).

use model::Body;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// Sets the inertia of a link at a pose, and the wrench that its velocity needs at zero acceleration.
#[inline(always)]
pub(crate) fn set_rigid_motion(
    body: Option<&Body>,
    rotation: &Matrix3<f64>,
    origin: &Vector3<f64>,
    velocity: &Vector6<f64>,
    inertia: &mut Matrix6<f64>,
    bias: &mut Vector6<f64>,
) {
    let Some(body) = body else {
        *inertia = Matrix6::zeros();
        *bias = Vector6::zeros();
        return;
    };
    let com = origin + rotation * body.com;
    let principal = body.principal_rotation(rotation);
    let scaled = Matrix3::from_columns(&[
        principal.column(0) * body.inertia.x,
        principal.column(1) * body.inertia.y,
        principal.column(2) * body.inertia.z,
    ]);
    let first = (com * body.mass).cross_matrix();
    let second = scaled * principal.transpose() - first * com.cross_matrix();

    inertia.fixed_view_mut::<3, 3>(0, 0).copy_from(&second);
    inertia.fixed_view_mut::<3, 3>(0, 3).copy_from(&first);
    inertia.fixed_view_mut::<3, 3>(3, 0).copy_from(&-first);
    inertia.fixed_view_mut::<3, 3>(3, 3).copy_from(&Matrix3::from_diagonal_element(body.mass));
    *bias = cross_force(velocity, &(*inertia * velocity));
}

#[inline(always)]
pub(crate) fn spatial(angular: Vector3<f64>, linear: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z)
}

#[inline(always)]
pub(crate) fn split(vector: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(vector[0], vector[1], vector[2]), Vector3::new(vector[3], vector[4], vector[5]))
}

/// `v × m` for motions.
#[inline(always)]
pub(crate) fn cross_motion(velocity: &Vector6<f64>, motion: &Vector6<f64>) -> Vector6<f64> {
    let (angular, linear) = split(velocity);
    let (rotation, translation) = split(motion);
    spatial(angular.cross(&rotation), angular.cross(&translation) + linear.cross(&rotation))
}

/// `v ×* f` for wrenches.
#[inline(always)]
pub(crate) fn cross_force(velocity: &Vector6<f64>, wrench: &Vector6<f64>) -> Vector6<f64> {
    let (angular, linear) = split(velocity);
    let (moment, force) = split(wrench);
    spatial(angular.cross(&moment) + linear.cross(&force), angular.cross(&force))
}
