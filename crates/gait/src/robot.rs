//! A robot that walks: its mechanism, and the half-step that was made for it.

use std::sync::Arc;

use model::Mechanism;

use crate::NominalTable;

/// A robot with the nominal half-step that was made for it.
#[derive(Clone, Debug)]
pub struct Robot {
    /// Mechanism of the robot.
    pub mechanism: Mechanism,
    /// Nominal half-step, made for this mechanism.
    pub nominal: Arc<NominalTable>,
}
