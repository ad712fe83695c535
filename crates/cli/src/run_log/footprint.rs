//! Where the feet stood: one footprint per foot at the start, and one for every landing.

use dynamics::{Kinematics, Tree};
use model::{Mechanism, Side};
use nalgebra::Isometry3;

use super::{ControllerRow, PlantRow, RunLog};

/// A place where a foot stood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Which foot.
    pub side: Side,
    /// Maps sole coordinates to world coordinates.
    pub sole_to_world: Isometry3<f64>,
}

impl Footprint {
    /// Which way the foot points on the floor, from x to y [rad].
    pub fn heading(&self) -> f64 {
        let forward = self.sole_to_world.rotation * nalgebra::Vector3::x();
        forward.y.atan2(forward.x)
    }
}

impl PlantRow {
    /// Where every link was.
    pub fn kinematics(&self, tree: &Tree) -> Kinematics {
        let mut kinematics = Kinematics::default();
        kinematics.float(tree, &self.right_sole_to_world, &self.angles);
        kinematics
    }

    /// Where a foot was.
    pub fn footprint(&self, mechanism: &Mechanism, tree: &Tree, side: Side) -> Footprint {
        Footprint { side, sole_to_world: self.kinematics(tree).sole_to_world(mechanism, side) }
    }
}

impl RunLog {
    /// The footprints in their order: first the foot that swings first, then the bearing foot of every half-step in its
    /// middle. So `n` completed half-steps leave `n + 2`: the two feet it stood on, and one for each landing.
    pub fn footprints(&self, mechanism: &Mechanism) -> Vec<Footprint> {
        let tree = Tree::new(mechanism);
        let mut prints = Vec::new();
        for half_step in self.half_steps() {
            let (first, last) = (&half_step[0], &half_step[half_step.len() - 1]);
            if prints.is_empty() {
                let start = self.plant_at(first.time);
                prints.extend(start.map(|row| row.footprint(mechanism, &tree, first.support.other())));
            }
            let middle = self.plant_at((first.time + last.time) / 2.0);
            prints.extend(middle.map(|row| row.footprint(mechanism, &tree, first.support)));
        }
        prints
    }

    /// The controller's rows, half-step by half-step.
    pub fn half_steps(&self) -> impl Iterator<Item = &[ControllerRow]> {
        self.controller.chunk_by(|before, after| before.half_step == after.half_step)
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{log, mechanism};
    use super::*;

    #[test]
    fn both_feet_stand_and_every_landing_leaves_a_print() {
        for half_steps in [0, 1, 7] {
            let prints = log(half_steps, 0.1).footprints(&mechanism());
            assert_eq!(prints.len() as u64, half_steps + 2);
            let sides: Vec<Side> = prints.iter().map(|print| print.side).collect();
            assert!(sides[0] == Side::Left && sides.windows(2).all(|pair| pair[0] != pair[1]), "{sides:?}");
        }
    }
}
