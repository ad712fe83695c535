//! The two half-steps that a steady walk repeats, one on either foot.
//!
//! All values are in support coordinates, as if the robot stood on its right foot.

use std::f64::consts::PI;

use dynamics::{Kinematics, Tree};
use gait::{Deflection, DeflectionPhase, Robot, StepExtension, WalkError, at_speed};
use interface::Command;
use model::{Mechanism, Motion, Side};
use nalgebra::{Isometry2, Vector2};

use super::Reading;

/// A half-step of a steady walk, at every boundary of the nominal's intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyHalfStep {
    /// The support foot.
    pub support: Side,
    /// Phase of the turn in this half-step.
    pub phase: DeflectionPhase,
    /// The motion at nominal speed without any lean, one value per interval boundary.
    pub at_nominal_speed: Vec<Motion>,
    /// Start and end of the swing foot.
    pub swing: Footing,
}

/// Poses of the swing foot at lift-off and landing, relative to the support foot in the plane of the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footing {
    /// Pose at the start of the half-step: maps sole coordinates to support coordinates.
    pub leaves: Isometry2<f64>,
    /// Pose at the end of the half-step: maps sole coordinates to support coordinates.
    pub lands: Isometry2<f64>,
}

impl SteadyHalfStep {
    /// The two half-steps of the steady walk under `command`, a deflecting one first if the walk turns.
    ///
    /// # Errors
    /// The mechanism cannot turn or extend its steps.
    pub fn steady(robot: &Robot, command: &Command, reading: Reading) -> Result<[Self; 2], WalkError> {
        let Robot { mechanism, nominal } = robot;
        let mut turn = Deflection::turn(mechanism, reading.turn);
        let mut extension = StepExtension::new(mechanism, reading.extension);
        turn.request(command.turn);
        extension.request(command.extension);

        let tree = Tree::new(mechanism);
        let half_step = |support: Side, turn: &Deflection, extension: &StepExtension| {
            let motion = |row: usize| {
                let progress = row as f64 / nominal.intervals() as f64;
                nominal.at(progress) + turn.at(progress, nominal.duration) + extension.at(progress, nominal.duration)
            };
            let at_nominal_speed: Vec<Motion> = (0..=nominal.intervals()).map(motion).collect();
            let [leaves, lands] =
                [0, nominal.intervals()].map(|row| swing_foot(mechanism, &tree, &at_nominal_speed[row]));
            Self { support, phase: turn.phase(), at_nominal_speed, swing: Footing { leaves, lands } }
        };
        // The first deflection may have to wait for its foot, and the first extended half-step begins without
        // extension: from the third half-step on the walk is steady.
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

    /// The motion at a constant `speed`, 1 being nominal.
    pub fn at_speed(&self, speed: f64) -> Vec<Motion> {
        self.at_nominal_speed.iter().map(|motion| at_speed(motion, speed, 0.0)).collect()
    }
}

impl Footing {
    /// The mirror image, for the other support foot.
    pub fn mirrored(&self) -> Self {
        let mirror = |pose: &Isometry2<f64>| {
            let at = pose.translation.vector;
            Isometry2::new(Vector2::new(at.x, -at.y), -pose.rotation.angle())
        };
        Self { leaves: mirror(&self.leaves), lands: mirror(&self.lands) }
    }
}

/// Pose of the swing sole in the plane of the floor.
fn swing_foot(mechanism: &Mechanism, tree: &Tree, motion: &Motion) -> Isometry2<f64> {
    let sole = Kinematics::fixed_base(tree, &motion.angles).sole_to_world(mechanism, Side::Left);
    let ahead = sole.rotation * nalgebra::Vector3::x();
    debug_assert!(ahead.xy().norm() > (PI / 4.0).cos(), "a sole that stands upright has no direction on the floor");
    Isometry2::new(sole.translation.vector.xy(), ahead.y.atan2(ahead.x))
}
