//! An uneven floor: square tiles, each at its own height.

use config::Table;
use nalgebra::Vector2;

use super::cut::Cut;
use super::tile_share::{is_where_the_walk_begins, tile_share};

/// Greatest height of a tile (m): twice as much, from a low tile to a high one, is more than any foot clears.
const HEIGHT_MAX: f64 = 0.1;

/// Unevenness of the floor; table `[unevenness]` of `config/plant.toml`. Around the world's origin, where the walk
/// begins, the floor is even.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unevenness {
    /// Greatest height or depth of a tile against the plane z = 0 (m).
    pub height: f64,
    /// Length of a tile's edge (m).
    pub tile: f64,
}

impl Default for Unevenness {
    fn default() -> Self {
        Self { height: 0.0, tile: 0.3 }
    }
}

impl Unevenness {
    /// Reads the table `[unevenness]`.
    pub(crate) fn read(table: &Table) -> Self {
        let tile = table.number("tile_m").between(0.01, 100.0);
        let height = table.number("height_m").between(0.0, HEIGHT_MAX);
        if height > tile {
            table.refuse("height_m", &format!("must be at most tile_m, which is {tile}"));
        }
        Self { height, tile }
    }

    /// Height of the floor at a place in the world (m); every seed has its own tiles.
    pub fn at(&self, place: Vector2<f64>, seed: u64) -> f64 {
        if self.height == 0.0 || is_where_the_walk_begins(place) {
            return 0.0;
        }
        self.height * (2.0 * tile_share(place, self.tile, seed) - 1.0)
    }

    /// The edges of the tiles in a square.
    pub(super) fn cuts(&self, centre: Vector2<f64>, half_edge: f64) -> Vec<Cut> {
        if self.height == 0.0 { Vec::new() } else { Cut::grid(Vector2::zeros(), self.tile, centre, half_edge) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_of_an_uneven_floor_are_level_and_fill_their_range() {
        let floor = Unevenness { height: 0.01, tile: 0.2 };
        let middle = |index: i32| Vector2::new(1.1 + 0.2 * f64::from(index % 80), 0.1 + 0.2 * f64::from(index / 80));
        let middles = (0..4000).map(middle);
        let heights: Vec<f64> = middles.clone().map(|place| floor.at(place, 3)).collect();
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        let spread = heights.iter().map(|height| height * height).sum::<f64>() / heights.len() as f64;
        assert!(heights.iter().all(|height| height.abs() <= 0.01));
        assert!(mean.abs() < 3e-4, "mean {mean}");
        assert!((spread - 1e-4 / 3.0).abs() < 2e-6, "an even spread has a third of the bound's square: {spread}");
        for (place, height) in middles.zip(heights) {
            assert_eq!(floor.at(place + Vector2::new(0.05, 0.05), 3), height, "one tile, one height");
        }
        assert_eq!(floor.at(Vector2::new(0.3, -0.4), 3), 0.0, "where the walk begins");
    }
}
