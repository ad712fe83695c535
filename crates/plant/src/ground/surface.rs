//! What a point of a sole touches.

use nalgebra::Vector3;

/// A surface near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Distance of the point below the surface; negative outside (m).
    pub depth: f64,
    /// Unit normal, out of the ground (-).
    pub normal: Vector3<f64>,
    /// Friction coefficient (-).
    pub friction: f64,
}

/// What of the ground a point touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The floor.
    pub floor: Surface,
    /// The upright side of a step that the point has gone into.
    pub wall: Option<Surface>,
}
