//! Positions on a grid.

use nalgebra::Vector3;

use crate::import::toml_text::{FINE, array};

/// Positions rounded in one frame, so that mirrored points stay mirrored and differences add up.
pub(super) struct Grid {
    /// The point under the right ankle (m).
    pub floor: Vector3<f64>,
}

/// A position in steps of the grid.
#[derive(Clone, Copy)]
pub(super) struct OnGrid([i64; 3]);

impl Grid {
    /// A position on the grid.
    pub(super) fn at(&self, point: Vector3<f64>) -> OnGrid {
        let point = point - Vector3::new(self.floor.x, 0.0, self.floor.z);
        OnGrid([point.x, point.y, point.z].map(|value| (value * FINE).round() as i64))
    }
}

impl OnGrid {
    /// The way to another position, as an array.
    pub(super) fn to(self, other: OnGrid) -> String {
        array((0..3).map(|axis| ((other.0[axis] - self.0[axis]) as f64 / FINE + 0.0).to_string()))
    }
}
