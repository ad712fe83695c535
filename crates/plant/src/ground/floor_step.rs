//! Steps: places from which on the floor is higher or lower. Several make stairs.

use config::Table;
use nalgebra::{Vector2, Vector3};

use super::cut::Cut;
use super::floor_extent::{FROM_MAX, FROM_MIN, direction};

/// Greatest height of a step (m): no robot of ours gets higher.
const HEIGHT_MAX: f64 = 0.5;

/// A straight step across the whole floor; table `[[floor.step]]` of `config/plant.toml`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorStep {
    /// Direction across the step, seen from where the walk begins: a unit vector (-).
    pub direction: Vector2<f64>,
    /// Distance of the edge from where the walk begins (m).
    pub from: f64,
    /// How much higher the floor is beyond; negative if it is lower (m).
    pub height: f64,
    /// After this distance the floor is as high as before (m); infinite if never.
    pub length: f64,
}

/// The upright side of a step, which a point has gone into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wall {
    /// Distance of the point behind the side (m).
    pub depth: f64,
    /// Unit normal of the side, level, out of the step (-).
    pub normal: Vector3<f64>,
    /// Height of the side (m).
    pub height: f64,
}

impl FloorStep {
    /// Reads a table `[[floor.step]]`.
    pub(super) fn read(table: &Table) -> Self {
        let length =
            if table.has("length_m") { table.number("length_m").between(0.01, FROM_MAX) } else { f64::INFINITY };
        Self {
            direction: direction(table),
            from: table.number("from_m").between(FROM_MIN, FROM_MAX),
            height: table.number("height_m").between(-HEIGHT_MAX, HEIGHT_MAX),
            length,
        }
    }

    /// What it adds to the height of the floor at a place (m).
    pub(super) fn height(&self, place: Vector2<f64>) -> f64 {
        let beyond = self.direction.dot(&place) - self.from;
        if beyond >= 0.0 && beyond < self.length { self.height } else { 0.0 }
    }

    /// The side that a point has gone into; `None` if it is not in the step, or nearer to the floor on top.
    ///
    /// * `place` – of the point (m)
    /// * `depth` – of the point below the floor on top (m)
    pub(super) fn entered(&self, place: Vector2<f64>, depth: f64) -> Option<Wall> {
        let beyond = self.direction.dot(&place) - self.from;
        let is_high = (beyond >= 0.0 && beyond < self.length) == (self.height > 0.0);
        if depth <= 0.0 || self.height == 0.0 || !is_high {
            return None;
        }
        // A hole is surrounded by what is higher, a rise is higher itself.
        let sign = if self.height > 0.0 { 1.0 } else { -1.0 };
        let sides = [(beyond * sign, -sign), ((self.length - beyond) * sign, sign)];
        let entered = sides.into_iter().filter(|(behind, _)| *behind >= 0.0 && *behind < depth);
        let (behind, out) = entered.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let normal = (self.direction * out).push(0.0);
        Some(Wall { depth: behind, normal, height: self.height.abs() })
    }

    /// Its edges.
    pub(super) fn cuts(&self) -> impl Iterator<Item = Cut> {
        let edges = [self.from, self.from + self.length].into_iter().filter(|edge| edge.is_finite());
        let direction = self.direction;
        edges.map(move |edge| Cut::across(direction, edge))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: FloorStep = FloorStep { direction: Vector2::new(1.0, 0.0), from: 2.0, height: 0.03, length: 1.0 };

    #[test]
    fn a_step_has_its_height_over_its_length() {
        for (x, height) in [(1.99, 0.0), (2.0, 0.03), (2.99, 0.03), (3.0, 0.0)] {
            assert_eq!(UP.height(Vector2::new(x, 5.0)), height, "{x}");
        }
    }

    #[test]
    fn sides_of_a_step_push_out_what_comes_from_the_side() {
        let entered = |step: &FloorStep, x: f64, depth: f64| step.entered(Vector2::new(x, 0.0), depth);
        let into_front = entered(&UP, 2.001, 0.02).expect("1 mm behind the front, 20 mm below the top");
        assert!((into_front.depth - 1e-3).abs() < 1e-12 && into_front.normal == -Vector3::x(), "{into_front:?}");
        let into_back = entered(&UP, 2.999, 0.02).expect("1 mm behind the back");
        assert!((into_back.depth - 1e-3).abs() < 1e-12 && into_back.normal == Vector3::x(), "{into_back:?}");
        assert_eq!(entered(&UP, 2.001, 1e-4), None, "it stands on top");
        assert_eq!(entered(&UP, 1.999, 1e-4), None, "before the step");
        let hole = FloorStep { height: -0.03, ..UP };
        assert_eq!(entered(&hole, 1.999, 0.02).map(|wall| wall.normal), Some(Vector3::x()), "into its near side");
        assert_eq!(entered(&hole, 3.001, 0.02).map(|wall| wall.normal), Some(-Vector3::x()), "into its far side");
    }
}
