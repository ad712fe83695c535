//! Velocities to ask for, and the true path of a walk.

use std::f64::consts::{PI, TAU};

use dynamics::arc_between;
use interface::{WalkPose, WalkVelocity};
use model::Side;
use nalgebra::Vector3;
use rand::{Rng, rngs::StdRng};

use crate::walking::Walking;

/// Any velocity of the range that the built-in robot is granted, and a little more.
pub fn random_velocity(random: &mut StdRng) -> WalkVelocity {
    WalkVelocity {
        ahead: random.random_range(-0.5..=1.15),
        left: random.random_range(-0.3..=0.3),
        turn: random.random_range(-60_f64..=60.0).to_radians(),
    }
}

/// The middle between the soles in the world, by the plant. Its heading is the mean of the soles', between −π and π.
pub fn true_pose(walking: &Walking) -> WalkPose {
    let soles = walking.plant.truth().soles;
    let middle = (soles[0].translation.vector + soles[1].translation.vector) / 2.0;
    let ahead: Vector3<f64> = Side::BOTH.into_iter().map(|side| soles[side.index()].rotation * Vector3::x()).sum();
    WalkPose { x: middle.x, y: middle.y, heading: ahead.y.atan2(ahead.x) }
}

/// The mean velocity over some time, seen from the robot.
#[derive(Clone, Debug)]
pub struct MeanVelocity {
    since: f64,
    last: (f64, WalkPose),
    sum: WalkPose,
}

impl MeanVelocity {
    /// From a time (s) and a pose on.
    pub fn since(time: f64, pose: WalkPose) -> Self {
        Self { since: time, last: (time, pose), sum: WalkPose::default() }
    }

    /// Goes on to a pose at a time (s).
    pub fn add(&mut self, time: f64, pose: WalkPose) {
        let before = self.last.1;
        let to = WalkPose { heading: before.heading + to_half_circle(pose.heading - before.heading), ..pose };
        let WalkPose { x, y, heading } = arc_between(&before, &to);
        self.sum = WalkPose { x: self.sum.x + x, y: self.sum.y + y, heading: self.sum.heading + heading };
        self.last = (time, pose);
    }

    /// The mean so far.
    pub fn value(&self) -> WalkVelocity {
        let WalkPose { x, y, heading } = self.sum;
        WalkVelocity { ahead: x, left: y, turn: heading }.scaled(1.0 / (self.last.0 - self.since))
    }
}

/// The same angle between −π and π (rad).
pub fn to_half_circle(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}
