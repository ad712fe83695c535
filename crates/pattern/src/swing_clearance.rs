//! Additional clearance of the swing sole over a body that tilts: without it a sole that swings ahead of a robot pushed
//! forward hits the ground early and takes over weight too soon.

use nalgebra::Vector2;
use signal::CriticallyDamped;

use crate::proportions::PatternProportions;

/// How the body is tilted beyond the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyTilt {
    /// The rotation, about x and y of support coordinates (rad).
    pub tilt: Vector2<f64>,
    /// Whether the robot recovers from a push.
    pub in_recovery: bool,
}

/// Additional height of the swing sole, so that it is where it was planned over the real floor: a critically damped
/// lag.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SwingClearance {
    /// Height (m) and its rate (m/s).
    height: CriticallyDamped<f64>,
}

impl SwingClearance {
    /// Advances by `dt` (s).
    ///
    /// * `tilt` – of the body beyond the plan
    /// * `sole` – the swing sole, in support coordinates (m)
    pub(crate) fn advance(
        &mut self,
        proportions: &PatternProportions,
        BodyTilt { tilt, in_recovery }: BodyTilt,
        sole: Vector2<f64>,
        dt: f64,
    ) {
        let lost = tilt.x * sole.y - tilt.y * sole.x;
        let max = proportions.swing_clearance_max;
        let time_constant = if in_recovery {
            proportions.swing_clearance_time_constant_in_recovery
        } else {
            proportions.swing_clearance_time_constant
        };
        self.height.advance((-lost).clamp(-max, max), time_constant, dt);
    }

    /// Expresses it over the other sole, which supports from now on.
    pub(crate) fn change_support(&mut self) {
        self.height = CriticallyDamped { value: -self.height.value, rate: -self.height.rate };
    }

    /// Additional height of the swing sole (m).
    pub(crate) fn of_sole(&self) -> f64 {
        self.height.value
    }

    /// Additional height of the hips (m): half as much, so that nothing jumps when the support changes.
    pub(crate) fn of_hips(&self) -> f64 {
        self.height.value / 2.0
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector3};

    use super::*;

    /// The oracle: the body rotated about O carries the sole along.
    #[test]
    fn swing_sole_of_a_tilted_body_keeps_its_planned_height() {
        let (tilt, sole) = (Vector2::new(0.02, 0.03), Vector2::new(0.2, 0.19));
        let mut clearance = SwingClearance::default();
        for _ in 0..100 {
            clearance.advance(
                &PatternProportions::of_built_in_robot(),
                BodyTilt { tilt, in_recovery: false },
                sole,
                0.01,
            );
        }
        let rotated = Rotation3::new(tilt.push(0.0)) * Vector3::new(sole.x, sole.y, clearance.of_sole());
        assert!(rotated.z.abs() < 2e-4, "{}", rotated.z);
    }

    #[test]
    fn hip_heights_over_both_soles_do_not_jump_at_a_support_change() {
        let mut clearance = SwingClearance::default();
        clearance.advance(
            &PatternProportions::of_built_in_robot(),
            BodyTilt { tilt: Vector2::new(0.02, 0.03), in_recovery: false },
            Vector2::new(0.2, 0.19),
            0.01,
        );
        let before = [clearance.of_hips(), clearance.of_hips() - clearance.of_sole()];
        clearance.change_support();
        let after = [clearance.of_hips() - clearance.of_sole(), clearance.of_hips()];
        assert_eq!(before, after, "over the one and the other sole");
    }
}
