//! Inverse kinematics of a leg of any structure, by Newton's method on its chain of six joints alone.
//!
//! As [`solve_leg`](crate::solve_leg), for planning: the chain is prepared once, and an iteration touches nothing but
//! six joints. With the angles of a moment ago as a first guess one or two iterations suffice.

use model::{Joint, JointVector, Mechanism, Side};
use nalgebra::{Isometry3, Matrix3, Matrix6, Vector3, Vector6};

use crate::inverse_kinematics::Unreachable;
use crate::joint_axis::JointAxis;
use crate::sin_cos::sin_cos;

/// Residual below which the next Newton step is the last one (m, rad): what is left is its square, 1e-9, and in the
/// angles of a nearly stretched leg some hundred times that.
const NEAR: f64 = 2e-5;
/// Most Newton steps.
const ITERATIONS_MAX: usize = 40;
/// Longest Newton step of a joint (rad); near the stretched leg full steps would diverge.
const STEP_MAX: f64 = 0.3;

/// The chain of a leg: from foot to pelvis on the right, from pelvis to foot on the left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegChain {
    joints: [Joint; 6],
    axes: [JointAxis; 6],
    /// Position of each joint in the frame of the link before it (m).
    origins: [Vector3<f64>; 6],
}

/// Where a link is: rotation to the world, and origin (m).
#[derive(Clone, Copy, Debug)]
struct Frame {
    rotation: Matrix3<f64>,
    origin: Vector3<f64>,
}

impl LegChain {
    /// The leg on a side of a mechanism.
    pub(crate) fn new(mechanism: &Mechanism, side: Side) -> Self {
        let joints = mechanism.leg(side);
        Self {
            joints,
            axes: joints.map(|joint| JointAxis::new(mechanism.links[joint].axis)),
            origins: joints.map(|joint| mechanism.links[joint].origin),
        }
    }

    /// Changes the six angles of the leg until the last link has the pose `target`, with the first joint on a link with
    /// the pose `base`. The angles given are the first guess.
    ///
    /// # Errors
    /// [`Unreachable`] leaves the closest angles found.
    #[inline]
    pub(crate) fn solve(
        &self,
        base: &Isometry3<f64>,
        target: &Isometry3<f64>,
        angles: &mut JointVector,
    ) -> Result<(), Unreachable> {
        let (base, target) = (Frame::of(base), Frame::of(target));
        let mut residual = f64::INFINITY;
        for _ in 0..ITERATIONS_MAX {
            let (end, axes, places) = self.place(&base, angles);
            let miss = end.to(&target);
            residual = miss.amax();
            if !residual.is_finite() {
                break;
            }
            let mut jacobian = Matrix6::zeros();
            for (column, (axis, place)) in axes.iter().zip(&places).enumerate() {
                jacobian.fixed_view_mut::<3, 1>(0, column).copy_from(&axis.cross(&(end.origin - place)));
                jacobian.fixed_view_mut::<3, 1>(3, column).copy_from(axis);
            }
            let Some(step) = jacobian.lu().solve(&miss) else { break };
            let shorten = (STEP_MAX / step.amax()).min(1.0);
            for (joint, change) in self.joints.into_iter().zip(step.iter()) {
                angles[joint] += change * shorten;
            }
            if residual < NEAR {
                return Ok(());
            }
        }
        Err(Unreachable { residual })
    }

    /// The last link, with the axes of all joints and their places (m).
    #[inline(always)]
    fn place(&self, base: &Frame, angles: &JointVector) -> (Frame, [Vector3<f64>; 6], [Vector3<f64>; 6]) {
        let mut link = *base;
        let (mut axes, mut places) = ([Vector3::zeros(); 6], [Vector3::zeros(); 6]);
        for index in 0..6 {
            link.origin += link.rotation * self.origins[index];
            places[index] = link.origin;
            (link.rotation, axes[index]) = self.axes[index].apply(&link.rotation, sin_cos(angles[self.joints[index]]));
        }
        (link, axes, places)
    }
}

impl Frame {
    fn of(pose: &Isometry3<f64>) -> Self {
        Self { rotation: pose.rotation.to_rotation_matrix().into_inner(), origin: pose.translation.vector }
    }

    /// Translation (m) and rotation vector (rad) to another frame, to first order.
    #[inline(always)]
    fn to(&self, target: &Frame) -> Vector6<f64> {
        let shift = target.origin - self.origin;
        let turn = target.rotation * self.rotation.transpose();
        let half = [turn.m32 - turn.m23, turn.m13 - turn.m31, turn.m21 - turn.m12].map(|twice| twice / 2.0);
        Vector6::new(shift.x, shift.y, shift.z, half[0], half[1], half[2])
    }
}
