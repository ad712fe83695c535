//! Angles, rates and accelerations of a leg whose ends stay parallel to the world.

use dynamics::{Kinematics, Tree, Unreachable, solve_leg};
use model::{Joint, JointVector, Mechanism, Motion, Side};
use nalgebra::{Isometry3, Matrix6, Vector3, Vector6};

/// Pitch angles of the first guess, from the foot up: shank ahead, thigh back, pelvis level (rad).
const FIRST_BEND: [f64; 3] = [0.3, -0.6, 0.3];

/// The first guess of inverse kinematics: both knees bent forward, on the right side of the stretched leg.
pub(crate) fn first_guess(mechanism: &Mechanism) -> JointVector {
    let mut angles = JointVector::ZERO;
    for side in Side::BOTH {
        // From the pelvis down each rotation is reversed; the order of the bends is the same either way.
        let direction = if side == Side::Right { 1.0 } else { -1.0 };
        let pitches = mechanism.leg(side).into_iter().filter(|&joint| mechanism.links[joint].axis.y.abs() > 0.5);
        for (joint, bend) in pitches.zip(FIRST_BEND) {
            angles[joint] = direction * bend * mechanism.links[joint].axis.y.signum();
        }
    }
    angles
}

/// Position of the far end of a leg, and its motion relative to the near end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegEnd {
    /// Position of the origin of the last link, in support coordinates (m).
    pub position: Vector3<f64>,
    /// Velocity relative to the leg's near end (m/s).
    pub velocity: Vector3<f64>,
    /// Acceleration relative to the leg's near end (m/s²).
    pub acceleration: Vector3<f64>,
}

/// Writes the motion of one leg into `motion`, whose angles are the first guess.
pub(crate) fn move_leg(tree: &Tree, leg: Side, end: &LegEnd, motion: &mut Motion) -> Result<(), Unreachable> {
    let target = Isometry3::from(end.position);
    solve_leg(tree, leg, &target, &mut motion.angles)?;

    let kinematics = Kinematics::fixed_base(tree, &motion.angles);
    let joints = tree.leg(leg);
    let jacobian = jacobian(&kinematics, &joints).lu();
    let stretched = Unreachable { residual: 0.0 };
    let rates = jacobian.solve(&spatial(end.velocity, Vector3::zeros())).ok_or(stretched)?;
    let drift = acceleration_without_drive(&kinematics, &joints, &rates);
    let accelerations = jacobian.solve(&(spatial(end.acceleration, Vector3::zeros()) - drift)).ok_or(stretched)?;
    for (index, joint) in joints.into_iter().enumerate() {
        motion.rates[joint] = rates[index];
        motion.accelerations[joint] = accelerations[index];
    }
    Ok(())
}

/// The Jacobian: linear and angular velocity of the leg's end per joint rate, in world axes.
fn jacobian(kinematics: &Kinematics, joints: &[Joint; 6]) -> Matrix6<f64> {
    let end = kinematics.origin[joints[5]];
    Matrix6::from_columns(&joints.map(|joint| {
        let axis = kinematics.axis[joint];
        spatial(axis.cross(&(end - kinematics.origin[joint])), axis)
    }))
}

/// Linear and angular acceleration of the leg's end at the given rates when no joint accelerates: J̇·q̇.
fn acceleration_without_drive(kinematics: &Kinematics, joints: &[Joint; 6], rates: &Vector6<f64>) -> Vector6<f64> {
    let (mut rate, mut angular, mut linear) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
    let mut origin = kinematics.origin[joints[0]];
    for (joint, &joint_rate) in joints.iter().copied().zip(rates.iter()) {
        let arm = kinematics.origin[joint] - origin;
        linear += angular.cross(&arm) + rate.cross(&rate.cross(&arm));
        origin = kinematics.origin[joint];
        let spin = kinematics.axis[joint] * joint_rate;
        angular += rate.cross(&spin);
        rate += spin;
    }
    spatial(linear, angular)
}

fn spatial(linear: Vector3<f64>, angular: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}
