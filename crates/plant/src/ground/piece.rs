//! A plane piece of the ground, for engines that know bodies only.

use nalgebra::{Vector2, Vector3};

/// A plane piece of the ground, convex and of one friction coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundPiece {
    /// Its corners in the world, counter-clockwise seen from above (m).
    pub corners: Vec<Vector3<f64>>,
    /// Friction coefficient (-).
    pub friction: f64,
}

impl GroundPiece {
    /// The piece over a polygon, through a point (m) with a unit normal.
    pub(super) fn over(outline: &[Vector2<f64>], point: Vector3<f64>, normal: Vector3<f64>, friction: f64) -> Self {
        let at = |place: &Vector2<f64>| {
            let offset = place - point.xy();
            place.push(point.z - (normal.x * offset.x + normal.y * offset.y) / normal.z)
        };
        Self { corners: outline.iter().map(at).collect(), friction }
    }
}
