//! The half-steps that a scenario repeats for ever: two, one on either foot.
//!
//! All is told in support coordinates, as if the robot stood on its right foot.

use std::f64::consts::PI;

use dynamics::{Kinematics, Tree};
use gait::{Command, StepExtension, Turn, TurnPhase, WalkError, at_speed};
use model::{Mechanism, Motion, Side};
use nalgebra::{Isometry2, Vector2};

use super::Reading;
use crate::configuration::Robot;

/// A half-step of a steady walk, at every boundary of the nominal's intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfStep {
    /// The foot that bears.
    pub support: Side,
    /// What it does about the turn.
    pub phase: TurnPhase,
    /// The path at nominal speed, without any lean.
    pub at_nominal_speed: Vec<Motion>,
    /// What the swing foot does.
    pub swing: Footing,
}

/// Where the swing foot leaves the ground and where it lands, seen from the bearing foot in the plane of the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footing {
    /// At the start of the half-step: maps sole coordinates to support coordinates.
    pub leaves: Isometry2<f64>,
    /// At its end.
    pub lands: Isometry2<f64>,
}

impl HalfStep {
    /// The two half-steps of the steady walk under `command`, a deflecting one first if the walk turns.
    ///
    /// # Errors
    /// When the mechanism cannot turn or extend its steps.
    pub fn steady(robot: &Robot, command: &Command, reading: Reading) -> Result<[Self; 2], WalkError> {
        let Robot { mechanism, nominal } = robot;
        let mut turn = Turn::new(mechanism, reading.turn)?;
        let mut extension = StepExtension::new(mechanism, reading.extension)?;
        turn.request(command.turn);
        extension.request(command.extension);

        let tree = Tree::new(mechanism);
        let half_step = |support: Side, turn: &Turn, extension: &StepExtension| {
            let motion = |row: usize| {
                let progress = row as f64 / nominal.intervals() as f64;
                nominal.at(progress) + turn.at(progress, nominal.duration) + extension.at(progress, nominal.duration)
            };
            let at_nominal_speed: Vec<Motion> = (0..=nominal.intervals()).map(motion).collect();
            let [leaves, lands] =
                [0, nominal.intervals()].map(|row| swing_foot(mechanism, &tree, &at_nominal_speed[row]));
            Self { support, phase: turn.phase(), at_nominal_speed, swing: Footing { leaves, lands } }
        };
        // The first deflection may have to wait for its foot, and the first extended half-step begins without extension:
        // from the fourth half-step on nothing is new.
        let mut support = if command.turn < 0.0 { Side::Left } else { Side::Right };
        let mut next = || {
            turn.begin_half_step(support);
            extension.begin_half_step();
            let begun = half_step(support, &turn, &extension);
            support = support.other();
            begun
        };
        let [_, _, first, second] = std::array::from_fn(|_| next());
        Ok([first, second])
    }

    /// The motion as it is at a constant `speed`.
    pub fn at_speed(&self, speed: f64) -> Vec<Motion> {
        self.at_nominal_speed.iter().map(|motion| at_speed(motion, speed, 0.0)).collect()
    }
}

impl Footing {
    /// The mirror image, for the other foot.
    pub fn mirrored(&self) -> Self {
        let mirror = |pose: &Isometry2<f64>| {
            let at = pose.translation.vector;
            Isometry2::new(Vector2::new(at.x, -at.y), -pose.rotation.angle())
        };
        Self { leaves: mirror(&self.leaves), lands: mirror(&self.lands) }
    }
}

/// Where the swing sole is in the plane of the floor.
fn swing_foot(mechanism: &Mechanism, tree: &Tree, motion: &Motion) -> Isometry2<f64> {
    let sole = Kinematics::standing(tree, &motion.angles).sole_to_world(mechanism, Side::Left);
    let ahead = sole.rotation * nalgebra::Vector3::x();
    debug_assert!(ahead.xy().norm() > (PI / 4.0).cos(), "a sole that stands upright has no direction on the floor");
    Isometry2::new(sole.translation.vector.xy(), ahead.y.atan2(ahead.x))
}
