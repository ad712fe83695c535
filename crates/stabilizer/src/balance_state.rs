//! The balance of the robot: what feedback compares.

use dynamics::ReferenceDynamics;
use model::ComState;
use nalgebra::Vector2;

/// How the robot balances, as planned or as estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceState {
    /// Centre of mass against the support sole.
    pub com: ComState,
    /// Tilt of the body beyond the plan, about x and y (rad).
    pub tilt: Vector2<f64>,
    /// Zero-moment point (m); estimated only while the support foot alone carries the robot.
    pub zmp: Option<Vector2<f64>>,
}

impl BalanceState {
    /// The balance of the commanded motion.
    pub fn planned(reference: &ReferenceDynamics) -> Self {
        Self { com: reference.com, tilt: Vector2::zeros(), zmp: Some(reference.zmp) }
    }
}
