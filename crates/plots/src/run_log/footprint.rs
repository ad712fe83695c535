//! Footprints: one per foot at the start, and one for every landing.

use dynamics::{Kinematics, Tree};
use model::{Mechanism, Side};
use nalgebra::{Isometry3, Rotation2, Vector2};

use super::{ControllerRow, PlantRow, RunLog};

/// A foot that bears for less is landing, or bounces (s).
const STANCE_MIN: f64 = 0.1;

/// Pose of a foot on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootPlacement {
    /// Side of the foot.
    pub side: Side,
    /// Maps sole coordinates to world coordinates.
    pub sole_to_world: Isometry3<f64>,
}

impl FootPlacement {
    /// Heading of the foot on the floor, from x to y (rad).
    pub fn heading(&self) -> f64 {
        let forward = self.sole_to_world.rotation * nalgebra::Vector3::x();
        forward.y.atan2(forward.x)
    }

    /// Expresses a point on the floor, in the foot's sole frame, in the world (m).
    pub fn to_world(&self, point: Vector2<f64>) -> Vector2<f64> {
        self.sole_to_world.translation.vector.xy() + Rotation2::new(self.heading()) * point
    }
}

impl PlantRow {
    /// Poses of all links.
    pub fn kinematics(&self, tree: &Tree) -> Kinematics {
        let mut kinematics = Kinematics::default();
        kinematics.compute_floating_base(tree, &self.right_sole_to_world, &self.angles);
        kinematics
    }

    /// Pose of a foot.
    pub fn footprint(&self, mechanism: &Mechanism, tree: &Tree, side: Side) -> FootPlacement {
        FootPlacement { side, sole_to_world: self.kinematics(tree).sole_to_world(mechanism, side) }
    }
}

impl RunLog {
    /// The footprints in their order: first the foot that swings first, then the support foot of every half-step in its
    /// middle. So `n` completed half-steps leave `n + 2`: the two feet of the start, and one for each landing. A foot
    /// that does not bear then, and what lies after a fall, leaves none. Without reports of the controller, each foot
    /// leaves one whenever it bears for a while.
    pub fn footprints(&self, mechanism: &Mechanism) -> Vec<FootPlacement> {
        let tree = Tree::new(mechanism);
        if self.controller.is_empty() {
            return self.footprints_by_load(mechanism, &tree);
        }
        let mut prints = Vec::new();
        for half_step in self.half_steps() {
            let (first, last) = (&half_step[0], &half_step[half_step.len() - 1]);
            if prints.is_empty() {
                // A walk begins with both feet on the floor, a part of one does not.
                let start = self.plant_at(first.time);
                let start = start.filter(|row| !self.is_part || row.bears(first.support.other()));
                prints.extend(start.map(|row| row.footprint(mechanism, &tree, first.support.other())));
            }
            let middle = self.plant_at((first.time + last.time) / 2.0);
            let middle = middle.filter(|row| row.bears(first.support) && !row.fallen);
            prints.extend(middle.map(|row| row.footprint(mechanism, &tree, first.support)));
        }
        prints
    }

    /// The pose of each foot in the middle of each time for which it bears.
    fn footprints_by_load(&self, mechanism: &Mechanism, tree: &Tree) -> Vec<FootPlacement> {
        let upright = self.plant.split(|row| row.fallen).next().unwrap_or_default();
        let stances = Side::BOTH.into_iter().flat_map(|side| {
            let stances = upright.chunk_by(move |before, after| before.bears(side) == after.bears(side));
            stances.filter(move |rows| rows[0].bears(side)).map(move |rows| (side, rows))
        });
        let lasting = stances.filter(|(_, rows)| rows[rows.len() - 1].time - rows[0].time >= STANCE_MIN);
        let mut middles: Vec<(Side, &PlantRow)> = lasting.map(|(side, rows)| (side, &rows[rows.len() / 2])).collect();
        middles.sort_by(|(_, one), (_, other)| one.time.total_cmp(&other.time));
        middles.into_iter().map(|(side, row)| row.footprint(mechanism, tree, side)).collect()
    }

    /// The controller's rows, half-step by half-step.
    pub fn half_steps(&self) -> impl Iterator<Item = &[ControllerRow]> {
        self.controller.chunk_by(|before, after| before.half_step == after.half_step)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::super::synthetic::{log, mechanism};
    use super::*;

    #[test]
    fn a_point_to_the_left_of_a_foot_is_to_its_left_in_the_world_whichever_foot_it_is() {
        let turned = Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2);
        let sole_to_world = Isometry3::new(Vector3::new(2.0, 1.0, 0.02), turned);
        // Ahead of a foot that points along the world's y is further along y; to its left is against x.
        for side in Side::BOTH {
            let found = FootPlacement { side, sole_to_world }.to_world(Vector2::new(0.2, 0.1));
            assert!((found - Vector2::new(1.9, 1.2)).norm() < 1e-12, "{side:?}: {found}");
        }
    }

    #[test]
    fn run_of_n_half_steps_has_n_plus_two_footprints() {
        for half_steps in [0, 1, 7] {
            let run = log(half_steps, 0.1);
            let prints = run.footprints(&mechanism());
            let of_plant = RunLog { controller: Vec::new(), ..run };
            assert_eq!(of_plant.footprints(&mechanism()), prints[1..], "all but the foot in the air at the start");
            assert_eq!(prints.len() as u64, half_steps + 2);
            let sides: Vec<Side> = prints.iter().map(|print| print.side).collect();
            assert!(sides[0] == Side::Left && sides.windows(2).all(|pair| pair[0] != pair[1]), "{sides:?}");
        }
    }
    #[test]
    fn a_foot_in_the_air_and_a_fallen_robot_leave_no_footprint() {
        let mut log = log(7, 0.0);
        log.plant[15].loads = [0.0, 0.0];
        log.plant[27..].iter_mut().for_each(|row| row.fallen = true);
        // Ticks 12 to 17 are the third half-step; from the middle of the fifth one on it lies on the floor.
        assert_eq!(log.footprints(&mechanism()).len(), 1 + 3);
    }
}
