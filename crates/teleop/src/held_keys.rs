//! Which directions are held, as far as the terminal tells.

use std::time::Duration;

use crate::drive_key::MoveKey;

/// How long a key counts as held after its last sign, where the terminal does not tell when it is let go: longer than
/// any usual delay before the first repeat, of at most 0.66 s.
pub(crate) const HOLD: Duration = Duration::from_millis(800);

/// Which directions are held. Times count from any one instant.
#[derive(Clone, Debug)]
pub(crate) struct HeldKeys {
    /// Whether the terminal tells when a key is let go.
    tells_release: bool,
    /// When each held key has last been heard of, in the order of the directions.
    heard: [Option<Duration>; MoveKey::ALL.len()],
}

impl HeldKeys {
    /// None is held.
    pub(crate) fn new(tells_release: bool) -> Self {
        Self { tells_release, heard: [None; MoveKey::ALL.len()] }
    }

    /// Whether the terminal tells when a key is let go.
    pub(crate) fn tells_release(&self) -> bool {
        self.tells_release
    }

    /// A key is pressed, or repeats. It takes the place of the opposite one.
    pub(crate) fn press(&mut self, direction: MoveKey, now: Duration) {
        self.release(direction.opposite());
        self.heard[direction as usize] = Some(now);
    }

    /// A key is let go.
    pub(crate) fn release(&mut self, direction: MoveKey) {
        self.heard[direction as usize] = None;
    }

    /// All keys are let go.
    pub(crate) fn release_all(&mut self) {
        self.heard = [None; MoveKey::ALL.len()];
    }

    /// Lets go of the keys that have not been heard of for long, where letting go is not told.
    pub(crate) fn expire(&mut self, now: Duration) {
        if !self.tells_release {
            for heard in &mut self.heard {
                *heard = heard.filter(|heard| now.saturating_sub(*heard) < HOLD);
            }
        }
    }

    /// The directions that are held.
    pub(crate) fn held(&self) -> impl Iterator<Item = MoveKey> {
        MoveKey::ALL.into_iter().filter(|direction| self.heard[*direction as usize].is_some())
    }

    /// Whether a direction is held.
    pub(crate) fn is_held(&self, direction: MoveKey) -> bool {
        self.heard[direction as usize].is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn held(keys: &HeldKeys) -> Vec<MoveKey> {
        keys.held().collect()
    }

    #[test]
    fn a_key_that_is_not_told_to_be_let_go_is_held_as_long_as_it_repeats() {
        let mut keys = HeldKeys::new(false);
        keys.press(MoveKey::Ahead, Duration::ZERO);
        for ms in (500..3000).step_by(33) {
            keys.expire(Duration::from_millis(ms));
            assert_eq!(held(&keys), [MoveKey::Ahead], "{ms} ms");
            keys.press(MoveKey::Ahead, Duration::from_millis(ms));
        }
        keys.expire(Duration::from_millis(2975 + 799));
        assert_eq!(held(&keys), [MoveKey::Ahead]);
        keys.expire(Duration::from_millis(2975 + 800));
        assert_eq!(held(&keys), []);
    }

    #[test]
    fn a_key_whose_release_is_told_is_held_until_then() {
        let mut keys = HeldKeys::new(true);
        keys.press(MoveKey::Ahead, Duration::ZERO);
        keys.press(MoveKey::TurnLeft, Duration::ZERO);
        keys.expire(Duration::from_secs(60));
        assert_eq!(held(&keys), [MoveKey::Ahead, MoveKey::TurnLeft], "both at a time");
        keys.release(MoveKey::TurnLeft);
        assert_eq!(held(&keys), [MoveKey::Ahead]);
        keys.release_all();
        assert_eq!(held(&keys), []);
    }

    #[test]
    fn the_opposite_key_takes_the_place_of_one() {
        for tells_release in [false, true] {
            let mut keys = HeldKeys::new(tells_release);
            keys.press(MoveKey::Left, Duration::ZERO);
            keys.press(MoveKey::Right, Duration::ZERO);
            assert_eq!(held(&keys), [MoveKey::Right]);
        }
    }
}
