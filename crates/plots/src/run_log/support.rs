//! Support polygon of the plant, and its capture point.

use dynamics::{SupportPolygon, Tree};
use model::{GRAVITY, Mechanism, Side};
use nalgebra::{Point3, Vector2};

use super::{PlantRow, RunLog};

/// Least share of the load on both feet with which a foot counts as on the ground (-).
const LOAD_SHARE_MIN: f64 = 0.07;

impl PlantRow {
    /// Whether the foot on `side` is on the ground.
    pub fn bears(&self, side: Side) -> bool {
        self.loads[side.index()] > LOAD_SHARE_MIN * (self.loads[0] + self.loads[1])
    }

    /// Convex hull of the soles on the ground, in world coordinates; a sole that tips counts as a whole.
    pub fn support_polygon(&self, mechanism: &Mechanism, tree: &Tree) -> SupportPolygon {
        self.hull_of_soles(mechanism, tree, |side| self.bears(side))
    }

    /// Convex hull of the soles for which `count` is true, in world coordinates.
    pub fn hull_of_soles(&self, mechanism: &Mechanism, tree: &Tree, count: impl Fn(Side) -> bool) -> SupportPolygon {
        let kinematics = self.kinematics(tree);
        let corners = Side::BOTH.into_iter().filter(|side| count(*side)).flat_map(|side| {
            let sole_to_world = kinematics.sole_to_world(mechanism, side);
            mechanism.sole.corners(side).map(|corner| (sole_to_world * Point3::from(corner)).coords.xy())
        });
        SupportPolygon::hull(corners)
    }
}

impl RunLog {
    /// The true divergent component of motion `c + ċ·√(z/g)` (the capture point) at a row of the plant, in world
    /// coordinates (m). True states have no velocities: `ċ` is the difference of the rows before and after. `None` if
    /// there is only one row, or the velocity is not estimated.
    pub fn divergent_component(&self, row: usize) -> Option<Vector2<f64>> {
        let here = self.plant.get(row)?;
        let before = &self.plant[row.saturating_sub(1)];
        let after = self.plant.get(row + 1).unwrap_or(here);
        let between = after.time - before.time;
        let velocity = if self.is_estimated {
            here.com_velocity?.xy()
        } else {
            (after.com_in_world - before.com_in_world).xy() / between
        };
        let swing_time = (here.com_in_world.z.max(0.0) / GRAVITY).sqrt();
        (between > 0.0).then(|| here.com_in_world.xy() + velocity * swing_time)
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{log, mechanism};
    use super::*;

    #[test]
    fn capture_point_of_a_falling_pendulum_matches_its_motion() {
        // x = cosh(ωt) has c + ċ/ω = e^(ωt).
        let mut log = log(3, 0.0);
        let rate = (GRAVITY / 0.9_f64).sqrt();
        for (tick, row) in log.plant.iter_mut().enumerate() {
            row.time = tick as f64 * 0.005;
            row.com_in_world.x = (rate * row.time).cosh();
            row.com_in_world.z = 0.9;
        }
        for row in 1..log.plant.len() - 1 {
            let expected = (rate * log.plant[row].time).exp();
            let found = log.divergent_component(row).unwrap();
            assert!((found.x - expected).abs() < 1e-3 && (found.y - 2.0).abs() < 1e-12, "{found} for {expected}");
        }
    }

    #[test]
    fn unloaded_feet_do_not_count_for_the_support_polygon() {
        let (mut log, mechanism) = (log(1, 0.0), mechanism());
        let tree = Tree::new(&mechanism);
        let row = &mut log.plant[0];
        assert!((row.support_polygon(&mechanism, &tree).margin(Vector2::zeros()) - 0.04).abs() < 1e-12);
        row.loads = [300.0, 400.0];
        // Between the feet, 9.5 cm from either ankle.
        assert!(row.support_polygon(&mechanism, &tree).margin(Vector2::new(0.0, 0.095)) > 0.05);
        row.loads = [40.0, 660.0];
        assert!(row.support_polygon(&mechanism, &tree).margin(Vector2::zeros()) < 0.0);
        row.loads = [0.0, 0.0];
        assert_eq!(row.support_polygon(&mechanism, &tree).margin(Vector2::zeros()), f64::NEG_INFINITY);
    }
}
