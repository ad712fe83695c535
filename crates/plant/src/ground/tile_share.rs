//! Random numbers of tiles: every seed has its own tiles, and none is stored.

use nalgebra::Vector2;

use crate::robot_sized::EVEN_HALF_EDGE;

/// A share from 0 to 1 for the square tile at a place, drawn with a seed (-).
pub(crate) fn tile_share(place: Vector2<f64>, tile: f64, seed: u64) -> f64 {
    let [column, row] = [place.x, place.y].map(|coordinate| (coordinate / tile).floor() as i64 as u64);
    let mixed = scramble(scramble(scramble(seed) ^ column) ^ row);
    (mixed >> 11) as f64 / (1u64 << 53) as f64
}

/// Whether a place is so near to where the walk begins that there are no tiles.
pub(crate) fn is_where_the_walk_begins(place: Vector2<f64>) -> bool {
    place.amax() < EVEN_HALF_EDGE
}

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): every bit of the input changes every bit of the output.
pub(crate) fn scramble(value: u64) -> u64 {
    let value = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let value = (value ^ (value >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    value ^ (value >> 31)
}
