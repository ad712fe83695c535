//! Patches of another friction: oil, ice, rubber.

use config::Table;
use nalgebra::Vector2;

use super::cut::Cut;
use super::floor_extent::{FRICTION_MAX, FROM_MAX};

/// A rectangle of the floor with a friction of its own; table `[[floor.friction_patch]]` of `config/plant.toml`. Where
/// several overlap, the last one in the file counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionPatch {
    /// Its middle in the world (m).
    pub at: Vector2<f64>,
    /// Lengths of its edges along x and y (m).
    pub size: Vector2<f64>,
    /// Friction coefficient (-).
    pub friction: f64,
}

impl FrictionPatch {
    /// Reads a table `[[floor.friction_patch]]`.
    pub(super) fn read(table: &Table) -> Self {
        Self {
            at: table.numbers("at_m").between(-FROM_MAX, FROM_MAX).into(),
            size: table.numbers("size_m").between(0.01, FROM_MAX).into(),
            friction: table.number("friction").between(0.0, FRICTION_MAX),
        }
    }

    /// Whether a place lies in it.
    pub(super) fn covers(&self, place: Vector2<f64>) -> bool {
        let offset = place - self.at;
        offset.x.abs() < self.size.x / 2.0 && offset.y.abs() < self.size.y / 2.0
    }

    /// Its edges.
    pub(super) fn cuts(&self) -> [Cut; 4] {
        let half = self.size / 2.0;
        Cut::around([self.at - half, self.at + half], 0.0)
    }
}
