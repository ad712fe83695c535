//! A held joint in forward dynamics.

use nalgebra::{Matrix6, Vector6};

/// Motion and drive of a held joint, for a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeldJointDrive {
    /// Angle against the one at which it is held (rad).
    pub deflection: f64,
    /// Rate (rad/s).
    pub rate: f64,
    /// Torque of its drive (N·m).
    pub torque: f64,
    /// Inertia added to its rotation, by rotor and implicitly integrated servo (kg·m²).
    pub armature: f64,
}

/// One held joint with the intermediates of forward dynamics.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldBody {
    pub drive: HeldJointDrive,
    pub velocity: Vector6<f64>,
    pub subspace: Vector6<f64>,
    pub bias_acceleration: Vector6<f64>,
    pub rigid_inertia: Matrix6<f64>,
    pub rigid_bias: Vector6<f64>,
    pub inertia: Matrix6<f64>,
    pub bias: Vector6<f64>,
    pub inertia_by_subspace: Vector6<f64>,
    pub resistance: f64,
    pub effort: f64,
    pub acceleration: Vector6<f64>,
    /// Acceleration of the joint (rad/s²).
    pub joint_acceleration: f64,
}
