//! The paths of the pelvis and of the swing foot over the half-step.
//!
//! Pelvis and feet stay parallel to the world, so each is a moving point, expressed in support coordinates. The end is
//! the mirror image of the start in position and velocity, and the swing foot starts and lands at rest: no impact.

use model::Mechanism;

use crate::jet::{Jet, PointMotion};

/// Paths over the progress of the half-step, which is a [`Jet`] from 0 to 1.
pub(crate) trait LegPath {
    /// Motion of the middle between the hip joints.
    fn pelvis(&self, progress: Jet) -> PointMotion;

    /// Motion of the left sole's origin, under its ankle.
    fn swing_sole(&self, progress: Jet) -> PointMotion;
}

/// Distance between the feet side by side, and between the hips above them (m).
pub(crate) fn hip_distance(mechanism: &Mechanism) -> f64 {
    mechanism.foot_distance()
}
