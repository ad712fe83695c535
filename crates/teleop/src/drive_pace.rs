//! How fast a held key moves the robot.

use interface::WalkVelocity;

use crate::drive_key::MoveKey;
use crate::held_keys::HeldKeys;

/// Velocity ahead at full pace of a robot of the paper's size (m/s).
const AHEAD: f64 = 1.0;
/// The same back (m/s).
const BACK: f64 = 0.45;
/// The same aside (m/s).
const ASIDE: f64 = 0.25;
/// Turning at full pace (rad/s).
const TURN: f64 = std::f64::consts::FRAC_PI_3;
/// Height of the paper robot's centre of mass while it walks (m).
const PAPER_HEIGHT: f64 = 0.96;
/// DrivePace in steps of 10 %.
const STEPS: u32 = 10;

/// The pace of held keys, as a share of the largest velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DrivePace(u32);

impl Default for DrivePace {
    fn default() -> Self {
        Self(STEPS / 2)
    }
}

impl DrivePace {
    /// One step faster.
    pub(crate) fn faster(self) -> Self {
        Self((self.0 + 1).min(STEPS))
    }

    /// One step slower.
    pub(crate) fn slower(self) -> Self {
        Self(self.0.saturating_sub(1).max(1))
    }

    /// In percent.
    pub(crate) fn percent(self) -> u32 {
        self.0 * 100 / STEPS
    }

    /// The velocity that the held keys ask for; zero if none is held. A small robot is asked for less, as the velocity
    /// of a pendulum grows with the square root of its length.
    ///
    /// * `height` – of the robot's centre of mass (m), if it is known
    pub(crate) fn velocity(self, keys: &HeldKeys, height: Option<f64>) -> WalkVelocity {
        let share = f64::from(self.0) / f64::from(STEPS);
        let size = height.filter(|height| *height > 0.0).map_or(1.0, |height| (height / PAPER_HEIGHT).sqrt());
        let axis = |one: (MoveKey, f64), other: (MoveKey, f64)| {
            let part = |(direction, most)| if keys.is_held(direction) { share * most } else { 0.0 };
            part(one) - part(other)
        };
        WalkVelocity {
            ahead: size * axis((MoveKey::Ahead, AHEAD), (MoveKey::Back, BACK)),
            left: size * axis((MoveKey::Left, ASIDE), (MoveKey::Right, ASIDE)),
            turn: axis((MoveKey::TurnLeft, TURN), (MoveKey::TurnRight, TURN)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn held_keys_add_up_to_a_velocity_at_the_pace() {
        let mut keys = HeldKeys::new(true);
        let pace = DrivePace::default();
        assert!(pace.velocity(&keys, None).is_zero());
        keys.press(MoveKey::Ahead, Duration::ZERO);
        keys.press(MoveKey::TurnRight, Duration::ZERO);
        let velocity = pace.velocity(&keys, None);
        assert_eq!(velocity, WalkVelocity { ahead: 0.5, left: 0.0, turn: -TURN / 2.0 });
        let small = pace.velocity(&keys, Some(PAPER_HEIGHT / 4.0));
        assert_eq!(small, WalkVelocity { ahead: 0.25, ..velocity });
    }

    #[test]
    fn the_pace_stays_between_a_tenth_and_all() {
        let mut pace = DrivePace::default();
        (0..20).for_each(|_| pace = pace.faster());
        assert_eq!(pace.percent(), 100);
        (0..20).for_each(|_| pace = pace.slower());
        assert_eq!(pace.percent(), 10);
    }
}
