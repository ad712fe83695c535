//! The zero-moment point (ZMP): the point at which the ground reaction acts (Vukobratović and Juričić 1968).

use model::Wrench;
use nalgebra::Vector2;

/// The point of the floor about which the wrench has no horizontal moment: x = −My/Fz, y = Mx/Fz (DESIGN §5.1) (m),
/// relative to the origin of the wrench, which must be a point of the floor.
///
/// Computed from a motion alone, the point may lie outside the sole: it is then fictitious and measures how much the
/// foot would tip. `None` when the ground does not push (Fz ≤ 0): there is no such point.
#[inline]
pub fn zmp(ground: &Wrench) -> Option<Vector2<f64>> {
    let weight = ground.force.z;
    (weight > 0.0).then(|| Vector2::new(-ground.moment.y / weight, ground.moment.x / weight))
}
