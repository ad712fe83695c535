//! Friction that changes from tile to tile.

use config::Table;
use nalgebra::Vector2;

use super::cut::Cut;
use super::floor_extent::FRICTION_MAX;
use super::tile_share::{is_where_the_walk_begins, scramble, tile_share};

/// Edge of a tile where none is set (m).
const TILE: f64 = 0.3;

/// Square tiles, each of its own friction; table `[floor.friction_tiles]` of `config/plant.toml`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionTiles {
    /// Least friction coefficient (-).
    pub least: f64,
    /// Greatest friction coefficient (-).
    pub greatest: f64,
    /// Length of a tile's edge (m).
    pub tile: f64,
}

impl FrictionTiles {
    /// Reads the table `[floor.friction_tiles]`.
    pub(super) fn read(table: &Table) -> Self {
        let least = table.number("least").between(0.0, FRICTION_MAX);
        let greatest = table.number("greatest").between(0.0, FRICTION_MAX);
        if greatest < least {
            table.refuse("greatest", &format!("must be at least `least`, which is {least}"));
        }
        let tile = if table.has("tile_m") { table.number("tile_m").between(0.01, 100.0) } else { TILE };
        Self { least, greatest, tile }
    }

    /// Friction coefficient at a place, of a run's seed (-); `None` where the walk begins.
    pub(super) fn at(&self, place: Vector2<f64>, seed: u64) -> Option<f64> {
        if is_where_the_walk_begins(place) {
            return None;
        }
        // Tiles of the same size are not the slippery ones because they are the low ones.
        let share = tile_share(place, self.tile, scramble(!seed));
        Some(self.least + share * (self.greatest - self.least))
    }

    /// The edges of the tiles in a square.
    pub(super) fn cuts(&self, centre: Vector2<f64>, half_edge: f64) -> Vec<Cut> {
        Cut::grid(Vector2::zeros(), self.tile, centre, half_edge)
    }
}
