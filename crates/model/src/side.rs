//! Right and left.

use serde::{Deserialize, Serialize};

/// A side of the body; for a half-step, the side of its support foot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The right side, y < 0.
    Right,
    /// The left side, y > 0.
    Left,
}

impl Side {
    /// Both sides, right first.
    pub const BOTH: [Side; 2] = [Side::Right, Side::Left];

    /// The other side.
    pub const fn other(self) -> Side {
        match self {
            Side::Right => Side::Left,
            Side::Left => Side::Right,
        }
    }

    /// Sign of a lateral coordinate with the support foot on this side: 1 on the right, where support coordinates are
    /// physical ones, −1 on the left, where they are mirrored.
    pub const fn lateral_sign(self) -> f64 {
        match self {
            Side::Right => 1.0,
            Side::Left => -1.0,
        }
    }

    /// Orders a pair of the right and the left foot by role: the foot on this side, which supports, comes first.
    pub fn support_first<T>(self, [right, left]: [T; 2]) -> [T; 2] {
        match self {
            Side::Right => [right, left],
            Side::Left => [left, right],
        }
    }

    /// The position in an array of both sides.
    pub const fn index(self) -> usize {
        self as usize
    }
}
