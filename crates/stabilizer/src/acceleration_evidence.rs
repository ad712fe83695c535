//! What a sample says about the acceleration of the centre of mass.

use nalgebra::Vector2;

/// What a sample says about the acceleration of the centre of mass, against the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccelerationEvidence {
    /// The zero-moment point beyond the planned one, if it is known (m).
    pub zmp: Option<Vector2<f64>>,
    /// Acceleration of the trunk beyond the planned one, if it is measured (m/s²).
    pub acceleration: Option<Vector2<f64>>,
    /// Whether the sole lies flat, so that an offset shows.
    pub is_flat: bool,
}
