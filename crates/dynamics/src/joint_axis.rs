//! The axis of a joint.

use nalgebra::{Matrix3, Unit, Vector3};

/// The axis of a joint. Nearly all are along a coordinate, where a rotation touches two columns only.
#[derive(Clone, Copy, Debug)]
pub(crate) enum JointAxis {
    X,
    Y,
    Z,
    About(Unit<Vector3<f64>>),
}

impl JointAxis {
    pub(crate) fn new(axis: Unit<Vector3<f64>>) -> Self {
        if axis == Vector3::x_axis() {
            JointAxis::X
        } else if axis == Vector3::y_axis() {
            JointAxis::Y
        } else if axis == Vector3::z_axis() {
            JointAxis::Z
        } else {
            JointAxis::About(axis)
        }
    }

    /// The child's rotation and the joint's axis in the world, from the parent's rotation and sine and cosine of the
    /// angle.
    #[inline(always)]
    pub(crate) fn apply(self, parent: &Matrix3<f64>, (sine, cosine): (f64, f64)) -> (Matrix3<f64>, Vector3<f64>) {
        let (x, y, z) = (parent.column(0), parent.column(1), parent.column(2));
        match self {
            JointAxis::X => {
                (Matrix3::from_columns(&[x.into(), y * cosine + z * sine, z * cosine - y * sine]), x.into())
            }
            JointAxis::Y => {
                (Matrix3::from_columns(&[x * cosine - z * sine, y.into(), x * sine + z * cosine]), y.into())
            }
            JointAxis::Z => {
                (Matrix3::from_columns(&[x * cosine + y * sine, y * cosine - x * sine, z.into()]), z.into())
            }
            JointAxis::About(axis) => {
                let across = axis.cross_matrix() * sine + axis.into_inner() * axis.transpose() * (1.0 - cosine);
                let rotation = Matrix3::from_diagonal_element(cosine) + across;
                (parent * rotation, parent * axis.into_inner())
            }
        }
    }
}
