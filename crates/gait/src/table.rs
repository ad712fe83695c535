//! The nominal half-step as a table: one row per interval boundary.

use model::{JointVector, Motion, Wrench};

/// One single-support half-step on the right foot, at `n_int + 1` equally spaced instants from 0 to T.
#[derive(Clone, Debug, PartialEq)]
pub struct NominalTable {
    /// `T` [s].
    pub duration: f64,
    /// From t = 0 to t = T inclusive.
    pub rows: Vec<NominalRow>,
    /// The command that made the table, for the file's header.
    pub made_by: String,
    /// Fingerprint of the mechanism for which it was made.
    pub mechanism: u64,
}

/// What the robot does at one instant, and what that takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NominalRow {
    /// Angles, rates and accelerations.
    pub motion: Motion,
    /// Torques that hold the posture against gravity [N·m].
    pub torque_gravity: JointVector,
    /// Torques of the motion itself; grow with the square of the speed (Hollerbach 1984) [N·m].
    pub torque_dynamic: JointVector,
    /// Wrench of the ground about O in support axes that carries the weight.
    pub ground_gravity: Wrench,
    /// Wrench of the ground about O in support axes that the motion itself needs.
    pub ground_dynamic: Wrench,
}
