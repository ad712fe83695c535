//! Velocities to ask for, and the true path of a walk.

use std::f64::consts::{PI, TAU};

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

/// The same angle between −π and π (rad).
pub fn to_half_circle(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}
