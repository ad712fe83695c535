//! Right and left.

use serde::{Deserialize, Serialize};

/// A side of the body; of a half-step, the side of the foot that bears.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// y < 0.
    Right,
    /// y > 0.
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

    /// The position in an array of both sides.
    pub const fn index(self) -> usize {
        self as usize
    }
}
