//! Points of a sole between its corners.
//!
//! Corners alone feel a plane floor, but not an edge or a bump between them. So where the floor rises over what the
//! corners stand on, points on a grid bear, too: the more, the more it rises, up to a millimetre, from which on they
//! bear as a corner does. On a plane they are not there, and they come in without a jump.

use model::{Side, Sole};
use nalgebra::Vector3;

/// Points along and across the sole, corners included.
const ALONG: usize = 13;
const ACROSS: usize = 3;

/// From this rise on a point bears as a corner does (m).
const FULL_RISE: f64 = 1e-3;
/// Less is a plane, but for rounding (m).
const LEAST_RISE: f64 = 1e-9;

/// A point of a sole between its corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SolePoint {
    /// Its place in the sole's frame (m).
    pub in_sole: Vector3<f64>,
    /// How much of each corner's height a plane through the corners has here (-).
    pub shares: [f64; Sole::CORNERS],
}

impl SolePoint {
    /// Number of points.
    pub(crate) const COUNT: usize = ALONG * ACROSS - Sole::CORNERS;

    /// Share of a corner's strength with which a point bears where the floor rises over what the corners stand on (-).
    ///
    /// * `rise` – by how much it does (m)
    pub(crate) fn bearing_share(rise: f64) -> f64 {
        if rise > LEAST_RISE { (rise / FULL_RISE).min(1.0) } else { 0.0 }
    }

    /// The points of the sole on `side`.
    pub(crate) fn all(sole: &Sole, side: Side) -> [Self; Self::COUNT] {
        let corners = sole.corners(side);
        let grid = (0..ALONG).flat_map(|along| (0..ACROSS).map(move |across| (along, across)));
        let is_corner = |(along, across): &(usize, usize)| along % (ALONG - 1) == 0 && across % (ACROSS - 1) == 0;
        let mut between = grid.filter(|at| !is_corner(at));
        std::array::from_fn(|_| {
            // As many as the array has places.
            let (along, across) = between.next().unwrap_or_default();
            let (ahead, left) = (along as f64 / (ALONG - 1) as f64, across as f64 / (ACROSS - 1) as f64);
            // The order of `Sole::corners`.
            let shares = [ahead * (1.0 - left), ahead * left, (1.0 - ahead) * left, (1.0 - ahead) * (1.0 - left)];
            let in_sole = std::iter::zip(&corners, shares).map(|(corner, share)| corner * share).sum();
            Self { in_sole, shares }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_between_the_corners_lie_on_edges_and_the_middle_line() {
        let sole = Sole { behind: 0.08, ahead: 0.12, inside: 0.03, outside: 0.05, ankle_height: 0.1 };
        let points = SolePoint::all(&sole, Side::Right);
        let along_edge = points.iter().filter(|point| (point.in_sole.y + 0.05).abs() < 1e-12).count();
        assert_eq!(along_edge, ALONG - 2, "the right edge without its corners");
        for SolePoint { in_sole, shares } in points {
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            assert!((-0.08..=0.12).contains(&in_sole.x), "{in_sole}");
            assert!([-0.05, -0.01, 0.03].iter().any(|y| (in_sole.y - y).abs() < 1e-12), "{in_sole}");
        }
    }
}
