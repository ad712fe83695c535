//! Where parts of the floor may lie, and in which direction.

use config::Table;
use nalgebra::Vector2;

use crate::robot_sized::EVEN_HALF_EDGE;

/// Least distance of an edge from where the walk begins (m): the robot starts on level ground.
pub(super) const FROM_MIN: f64 = EVEN_HALF_EDGE;
/// Greatest distance or length (m): an hour's walk.
pub(super) const FROM_MAX: f64 = 4000.0;
/// Greatest friction coefficient (-).
pub(super) const FRICTION_MAX: f64 = 10.0;

/// The optional `heading_deg` of a table as a unit vector: 0 is ahead, 90 to the left.
pub(super) fn direction(table: &Table) -> Vector2<f64> {
    let heading = if table.has("heading_deg") { table.angle("heading_deg").between(-360.0, 360.0) } else { 0.0 };
    let (sin, cos) = libm::sincos(heading);
    Vector2::new(cos, sin)
}
