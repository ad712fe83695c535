//! Pieces of the floor as bodies.

use nalgebra::Vector3;
use plant::GroundPiece;

/// How far a body reaches below its lowest corner (m): more than a sole ever sinks in.
const THICKNESS: f64 = 0.3;

/// A convex body whose top is a piece of the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct FloorPrism {
    /// Its place in the world (m).
    pub at: Vector3<f64>,
    /// Its vertices from there (m): MuJoCo holds them in single precision, which is enough for short distances only.
    pub vertices: Vec<Vector3<f64>>,
    /// Friction coefficient (-).
    pub friction: f64,
}

impl FloorPrism {
    /// The body under a piece of the floor.
    pub fn of(piece: &GroundPiece) -> Self {
        let at = piece.corners.iter().sum::<Vector3<f64>>() / piece.corners.len() as f64;
        let top = piece.corners.iter().map(|corner| corner - at);
        let bottom = top.clone().map(|corner| corner.z).fold(0.0, f64::min) - THICKNESS;
        let vertices = top.clone().chain(top.map(|corner| Vector3::new(corner.x, corner.y, bottom))).collect();
        Self { at, vertices, friction: piece.friction }
    }
}
