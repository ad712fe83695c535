//! What the drives are to reach at the end of a control period.

use model::JointVector;

/// What the drives are to reach at the end of a control period, by physical joint. Values of the unpowered joints 1 and
/// 2 have no meaning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// Joint angles (rad).
    pub angles: JointVector,
    /// Joint rates (rad/s).
    pub rates: JointVector,
    /// Torques that the motion is expected to need (N·m), added to those of the position servos.
    pub feed_forward: JointVector,
}
