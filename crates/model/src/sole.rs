//! The sole: a rectangle under the ankle.

use nalgebra::Vector3;

/// A rectangular sole. Its frame has the origin on the sole under the ankle, x forward, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sole {
    /// Distance from the ankle back to the heel edge (m).
    pub behind: f64,
    /// Distance from the ankle forward to the toe edge (m).
    pub ahead: f64,
    /// Half of the sole's width (m).
    pub half_width: f64,
    /// Height of the ankle above the sole (m).
    pub ankle_height: f64,
}

impl Sole {
    /// Number of corners.
    pub const CORNERS: usize = 4;

    /// The corners in the sole frame (m), counter-clockwise seen from above, the right toe first.
    pub fn corners(&self) -> [Vector3<f64>; Sole::CORNERS] {
        let Sole { behind, ahead, half_width, .. } = *self;
        [
            Vector3::new(ahead, -half_width, 0.0),
            Vector3::new(ahead, half_width, 0.0),
            Vector3::new(-behind, half_width, 0.0),
            Vector3::new(-behind, -half_width, 0.0),
        ]
    }

    /// Signed distance of a point of the sole plane to the nearest edge (m): positive inside, negative outside.
    pub fn margin(&self, x: f64, y: f64) -> f64 {
        let outside_x = (x - self.ahead).max(-self.behind - x);
        let outside_y = y.abs() - self.half_width;
        if outside_x > 0.0 && outside_y > 0.0 { -outside_x.hypot(outside_y) } else { -outside_x.max(outside_y) }
    }
}
