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
    /// The support foot; estimated only while it bears.
    pub foot: Option<SupportFoot>,
}

/// The support foot on ground that is not as planned.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SupportFoot {
    /// Rotation of its sole beyond the planned one, about x and y (rad): it stands on a stone, or tips over its edge.
    pub tilt: Vector2<f64>,
    /// Whether it lies flat on the ground, not on an edge.
    pub is_flat: bool,
}

impl BalanceState {
    /// The balance of the commanded motion.
    pub fn planned(reference: &ReferenceDynamics) -> Self {
        Self {
            com: reference.com,
            tilt: Vector2::zeros(),
            zmp: Some(reference.zmp),
            foot: Some(SupportFoot::default()),
        }
    }
}
