//! The sole: a rectangle under the ankle, mirrored on the other foot.

use nalgebra::{Vector2, Vector3};

use crate::Side;

/// A rectangular sole. Its frame has the origin on the sole under the ankle, x forward, y to the left, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sole {
    /// Distance from the ankle back to the heel edge (m).
    pub behind: f64,
    /// Distance from the ankle forward to the toe edge (m).
    pub ahead: f64,
    /// Distance from the ankle to the edge on the side of the other foot (m).
    pub inside: f64,
    /// Distance from the ankle to the outer edge (m).
    pub outside: f64,
    /// Height of the ankle above the sole (m).
    pub ankle_height: f64,
}

impl Sole {
    /// Number of corners.
    pub const CORNERS: usize = 4;

    /// Half of the sole's length and width (m).
    pub fn half_size(&self) -> Vector2<f64> {
        Vector2::new((self.ahead + self.behind) / 2.0, (self.inside + self.outside) / 2.0)
    }

    /// The middle of the sole on `side`, in its frame (m).
    pub fn centre(&self, side: Side) -> Vector2<f64> {
        let [right, left] = self.edges_aside(side);
        Vector2::new((self.ahead - self.behind) / 2.0, (left - right) / 2.0)
    }

    /// Distance from the ankle to the right and to the left edge of the sole on `side` (m).
    pub fn edges_aside(&self, side: Side) -> [f64; 2] {
        match side {
            Side::Right => [self.outside, self.inside],
            Side::Left => [self.inside, self.outside],
        }
    }

    /// The corners of the sole on `side`, in its frame (m), counter-clockwise seen from above, the right toe first.
    pub fn corners(&self, side: Side) -> [Vector3<f64>; Sole::CORNERS] {
        let Sole { behind, ahead, .. } = *self;
        let [right, left] = self.edges_aside(side);
        [
            Vector3::new(ahead, -right, 0.0),
            Vector3::new(ahead, left, 0.0),
            Vector3::new(-behind, left, 0.0),
            Vector3::new(-behind, -right, 0.0),
        ]
    }

    /// Signed distance of a point of the plane of the right sole, in its frame, to the nearest edge (m): positive
    /// inside, negative outside.
    pub fn margin(&self, x: f64, y: f64) -> f64 {
        let outside_x = (x - self.ahead).max(-self.behind - x);
        let outside_y = (y - self.inside).max(-self.outside - y);
        if outside_x > 0.0 && outside_y > 0.0 { -libm::hypot(outside_x, outside_y) } else { -outside_x.max(outside_y) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHIFTED: Sole = Sole { behind: 0.07, ahead: 0.21, inside: 0.02, outside: 0.05, ankle_height: 0.07 };

    #[test]
    fn left_sole_is_the_mirror_image_of_the_right_one() {
        let [right, left] = Side::BOTH.map(|side| SHIFTED.corners(side));
        for corner in right {
            let image = Vector3::new(corner.x, -corner.y, corner.z);
            assert!(left.iter().any(|other| (other - image).norm() < 1e-15), "{image}");
        }
        let [right, left] = Side::BOTH.map(|side| SHIFTED.centre(side));
        assert!((right - Vector2::new(0.07, -0.015)).norm() < 1e-15, "{right}");
        assert!((left - Vector2::new(0.07, 0.015)).norm() < 1e-15, "{left}");
    }

    /// The left foot is to the left of the right one.
    #[test]
    fn margin_of_the_right_sole_is_that_to_its_own_edges() {
        for (y, margin) in [(0.0, 0.02), (0.03, -0.01), (-0.04, 0.01), (-0.015, 0.035), (-0.06, -0.01)] {
            assert!((SHIFTED.margin(0.0, y) - margin).abs() < 1e-15, "{y}");
        }
        let out = SHIFTED.margin(0.24, 0.06);
        assert!((out + 0.05).abs() < 1e-15, "beyond the corner by 3 cm and 4 cm: {out}");
    }
}
