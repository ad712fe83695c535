//! The path of the swinging sole: as the modified half-step has it, but from where the foot really stands to a landing on
//! the ground, level and at rest at both ends.
//!
//! The plain sum of joint offsets leaves the sole millimetres above or below the ground when a longer step ends, and lets
//! it land with the heading's share of the robot's speed when a turn ends; either would be a blow.

use nalgebra::Vector4;

use crate::preview::SolePose;

/// One half-step's path over its progress from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingPath {
    /// Corrections of position and yaw: at the start, at the end; their rates per progress likewise.
    start: Vector4<f64>,
    end: Vector4<f64>,
    start_rate: Vector4<f64>,
    end_rate: Vector4<f64>,
}

/// Step of progress over which the path's rates are taken.
const RATE_STEP: f64 = 1e-4;

impl SwingPath {
    /// Begins a half-step.
    ///
    /// * `standing` – where the foot stands
    /// * `landing` – where it is to land
    /// * `asked` – the swinging sole of the modified half-step at a progress
    pub fn new(standing: &SolePose, landing: &SolePose, asked: impl Fn(f64) -> SolePose) -> Self {
        let (first, last) = (vector(&asked(0.0)), vector(&asked(1.0)));
        let start_rate = (vector(&asked(RATE_STEP)) - first) / RATE_STEP;
        let end_rate = (last - vector(&asked(1.0 - RATE_STEP))) / RATE_STEP;
        Self { start: vector(standing) - first, end: vector(landing) - last, start_rate, end_rate }
    }

    /// The sole at `progress`, from what the modified half-step asks there.
    pub fn at(&self, progress: f64, asked: &SolePose) -> SolePose {
        let s = progress;
        let blend = smooth_step(s);
        let leaving = s * (1.0 - s) * (1.0 - s);
        let arriving = -s * s * (1.0 - s);
        pose(
            vector(asked) + self.start * (1.0 - blend) + self.end * blend
                - self.start_rate * leaving
                - self.end_rate * arriving,
        )
    }
}

/// From 0 to 1 with rate and acceleration zero at both ends.
pub fn smooth_step(s: f64) -> f64 {
    s * s * s * (10.0 + s * (-15.0 + 6.0 * s))
}

fn vector(pose: &SolePose) -> Vector4<f64> {
    pose.position.push(pose.yaw)
}

fn pose(vector: Vector4<f64>) -> SolePose {
    SolePose { position: vector.xyz(), yaw: vector.w }
}
