//! A motion at one instant.

use crate::{JointVector, Mirror, Mirrored};

/// Angles (rad), rates (rad/s) and accelerations (rad/s²) of all joints at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Joint angles (rad).
    pub angles: JointVector,
    /// Joint rates (rad/s).
    pub rates: JointVector,
    /// Joint accelerations (rad/s²).
    pub accelerations: JointVector,
}

impl Motion {
    /// A posture (rad) at rest.
    pub fn at_rest(angles: JointVector) -> Self {
        Self { angles, ..Self::default() }
    }

    /// The motion at the middle one of three postures that follow each other every `step` seconds, by central
    /// differences.
    pub fn between(before: &JointVector, here: &JointVector, after: &JointVector, step: f64) -> Self {
        Self {
            angles: *here,
            rates: (*after - *before) * (0.5 / step),
            accelerations: (*after + *before - *here * 2.0) * (1.0 / (step * step)),
        }
    }

    /// Whether no value is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        self.angles.is_finite() && self.rates.is_finite() && self.accelerations.is_finite()
    }
}

impl Mirrored for Motion {
    fn mirrored(&self, mirror: &Mirror) -> Self {
        Self {
            angles: mirror.apply(&self.angles),
            rates: mirror.apply(&self.rates),
            accelerations: mirror.apply(&self.accelerations),
        }
    }
}

impl std::ops::Add for Motion {
    type Output = Motion;

    fn add(self, other: Motion) -> Motion {
        Motion {
            angles: self.angles + other.angles,
            rates: self.rates + other.rates,
            accelerations: self.accelerations + other.accelerations,
        }
    }
}
