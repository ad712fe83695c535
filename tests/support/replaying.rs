//! A walk in very small integration steps, and parts of it played again in larger ones.
//!
//! The walk is controlled; what is played again is not. An upright robot that nobody controls falls, and any difference
//! grows by a factor of e every 0.3 s: so parts are short.

use dynamics::Tree;
use interface::{Measurement, Setpoint};
use model::{Joint, Mechanism};
use plant::{Plant, RobotState, SensorParameters};

use crate::walking::{Walking, controller_parameters, plant_parameters};

/// Integration steps per control period of the walk: 10 µs each.
pub const REFERENCE_STEPS: u32 = 100;

/// The walk, by control periods.
#[derive(Default)]
pub struct Reference {
    /// The simulated robot at the beginning of each.
    pub plants: Vec<Plant>,
    /// What was played in each.
    pub setpoints: Vec<Setpoint>,
}

/// How far a robot is from where it should be: a mean square over many, or its root.
#[derive(Clone, Copy, Debug, Default)]
pub struct Apart {
    /// The powered joints' angles (rad).
    pub joints: f64,
    /// Where the trunk is (m).
    pub place: f64,
    /// How the trunk is turned (rad).
    pub turn: f64,
}

impl Reference {
    /// So many control periods of the nominal walk, the plant moved on by `step`. Its sensors tell the truth.
    pub fn walk(
        mechanism: &Mechanism,
        periods: usize,
        mut step: impl FnMut(&mut Plant, &Setpoint) -> Measurement,
    ) -> Self {
        let plant = plant::PlantParameters {
            steps_per_period: REFERENCE_STEPS,
            sensors: SensorParameters::PERFECT,
            ..plant_parameters()
        };
        let mut walking = Walking::begin_with(mechanism, &controller_parameters(), &plant, 0);
        let mut reference = Self::default();
        for _ in 0..periods {
            let report = walking.tick_in(None, |plant, setpoint| {
                reference.plants.push(plant.clone());
                reference.setpoints.push(*setpoint);
                step(plant, setpoint)
            });
            assert!(!walking.has_fallen(&report), "the nominal walk falls");
        }
        reference
    }

    /// Plays control periods again from some `starts` by the plant that `begin` makes of the walk's, and tells how far
    /// it is from the walk `after` so many: the root of the mean square over all starts.
    pub fn apart<S: FnMut(&mut Plant, &Setpoint) -> Measurement, const N: usize>(
        &self,
        mechanism: &Mechanism,
        starts: &[usize],
        after: [usize; N],
        mut begin: impl FnMut(&Plant) -> (Plant, S),
    ) -> [Apart; N] {
        let tree = Tree::new(mechanism);
        let mut sums = [Apart::default(); N];
        for &start in starts {
            let (mut plant, mut step) = begin(&self.plants[start]);
            let mut now = start;
            for (sum, after) in sums.iter_mut().zip(after) {
                for setpoint in &self.setpoints[now..start + after] {
                    step(&mut plant, setpoint);
                }
                now = start + after;
                *sum = *sum + Apart::squared(&tree, &plant.robot, &self.plants[now].robot);
            }
        }
        let mean = |sum: f64| (sum / starts.len() as f64).sqrt();
        sums.map(|sum| Apart { joints: mean(sum.joints), place: mean(sum.place), turn: mean(sum.turn) })
    }
}

impl Apart {
    fn squared(tree: &Tree, one: &RobotState, other: &RobotState) -> Self {
        let trunk = |robot: &RobotState| robot.kinematics(tree).link_to_world(Joint::WaistRoll);
        let (one_trunk, other_trunk) = (trunk(one), trunk(other));
        let apart = one.angles - other.angles;
        let powered = Joint::ALL.iter().filter(|joint| joint.is_powered());
        Self {
            joints: powered.clone().map(|&joint| apart[joint].powi(2)).sum::<f64>() / powered.count() as f64,
            place: (one_trunk.translation.vector - other_trunk.translation.vector).norm_squared(),
            turn: one_trunk.rotation.angle_to(&other_trunk.rotation).powi(2),
        }
    }
}

impl std::ops::Add for Apart {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { joints: self.joints + other.joints, place: self.place + other.place, turn: self.turn + other.turn }
    }
}
