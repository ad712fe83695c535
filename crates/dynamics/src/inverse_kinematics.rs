//! Leg inverse kinematics: six joints that bring one end of a leg into a pose.
//!
//! Newton's method on the geometric Jacobian. It reads the axes from the mechanism, so it serves every axis reading,
//! and with the angles of a moment ago as a first guess it needs two or three iterations.

use model::{JointOrder, JointVector, Side};
use nalgebra::{Isometry3, Matrix6, UnitQuaternion, Vector3, Vector6};

use crate::{Kinematics, Tree};

/// Residual below which a pose counts as reached (m, rad).
pub(crate) const TOLERANCE: f64 = 1e-12;
/// Most Newton steps; two or three are usual.
const ITERATIONS_MAX: usize = 40;
/// Longest Newton step of a joint (rad); near the stretched leg full steps would diverge.
const STEP_MAX: f64 = 0.3;

/// The pose cannot be reached, or only through a stretched knee.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unreachable {
    /// Largest component of the remaining difference of poses (m, rad).
    pub residual: f64,
}

/// Changes the six angles of a leg in `angles` until the link at its end, the pelvis for the right leg and the foot for
/// the left one, has the pose `target` (link to support
/// coordinates), all other angles kept. The angles given are the first guess and choose the way the knee bends.
///
/// # Errors
/// [`Unreachable`] leaves the closest angles found.
pub fn solve_leg(tree: &Tree, leg: Side, target: &Isometry3<f64>, angles: &mut JointVector) -> Result<(), Unreachable> {
    let mut kinematics = Kinematics::fixed_base(tree, angles);
    let mut residual = f64::INFINITY;
    let joints = tree.leg(leg);
    for _ in 0..ITERATIONS_MAX {
        // The links that carry the leg stay where they are.
        kinematics.chain(tree, angles, JointOrder::places_of_leg(leg));
        let end = kinematics.link_to_world(joints[5]);
        let miss = pose_difference(&end, target);
        residual = miss.amax();
        if residual < TOLERANCE {
            return Ok(());
        }

        let mut jacobian = Matrix6::zeros();
        for (column, joint) in joints.into_iter().enumerate() {
            let axis = kinematics.axis[joint];
            let arm = end.translation.vector - kinematics.origin[joint];
            jacobian.fixed_view_mut::<3, 1>(0, column).copy_from(&axis.cross(&arm));
            jacobian.fixed_view_mut::<3, 1>(3, column).copy_from(&axis);
        }
        let Some(step) = jacobian.lu().solve(&miss) else { break };
        let shorten = (STEP_MAX / step.amax()).min(1.0);
        for (joint, change) in joints.into_iter().zip(step.iter()) {
            angles[joint] += change * shorten;
        }
    }
    // Rounding may keep the last bits from settling.
    if residual < 1e3 * TOLERANCE { Ok(()) } else { Err(Unreachable { residual }) }
}

/// Translation (m) and rotation vector (rad) from one pose to another, in world axes.
fn pose_difference(from: &Isometry3<f64>, to: &Isometry3<f64>) -> Vector6<f64> {
    let shift: Vector3<f64> = to.translation.vector - from.translation.vector;
    let rotation = rotation_vector(&(to.rotation * from.rotation.inverse()));
    Vector6::new(shift.x, shift.y, shift.z, rotation.x, rotation.y, rotation.z)
}

/// The rotation vector to first order, which is enough for Newton's last steps. So no function of the system's
/// mathematical library, whose last bits differ from machine to machine, enters the result.
fn rotation_vector(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    rotation.imag() * if rotation.w < 0.0 { -2.0 } else { 2.0 }
}
