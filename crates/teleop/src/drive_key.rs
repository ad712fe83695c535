//! What the keys mean.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// A direction in which a held key moves the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MoveKey {
    Ahead,
    Back,
    TurnLeft,
    TurnRight,
    Left,
    Right,
}

impl MoveKey {
    pub(crate) const ALL: [Self; 6] =
        [Self::Ahead, Self::Back, Self::TurnLeft, Self::TurnRight, Self::Left, Self::Right];

    /// Its name on the screen.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Ahead => "ahead",
            Self::Back => "back",
            Self::TurnLeft => "turn left",
            Self::TurnRight => "turn right",
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// The direction that it cannot go with.
    pub(crate) const fn opposite(self) -> Self {
        match self {
            Self::Ahead => Self::Back,
            Self::Back => Self::Ahead,
            Self::TurnLeft => Self::TurnRight,
            Self::TurnRight => Self::TurnLeft,
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DriveKey {
    Move(MoveKey),
    Faster,
    Slower,
    Stop,
    Hold,
    Reset,
    Leave,
}

impl DriveKey {
    /// The meaning of a key, if it has one.
    pub(crate) fn of(event: &KeyEvent) -> Option<Self> {
        let KeyEvent { code, modifiers, .. } = *event;
        if modifiers.contains(KeyModifiers::CONTROL) {
            return matches!(code, KeyCode::Char('c' | 'C')).then_some(Self::Leave);
        }
        let key = match code {
            KeyCode::Esc => Self::Leave,
            KeyCode::Up => Self::Move(MoveKey::Ahead),
            KeyCode::Down => Self::Move(MoveKey::Back),
            KeyCode::Left => Self::Move(MoveKey::TurnLeft),
            KeyCode::Right => Self::Move(MoveKey::TurnRight),
            // Caps Lock may be on.
            KeyCode::Char(character) => match character.to_ascii_lowercase() {
                'w' => Self::Move(MoveKey::Ahead),
                's' => Self::Move(MoveKey::Back),
                'a' => Self::Move(MoveKey::TurnLeft),
                'd' => Self::Move(MoveKey::TurnRight),
                'q' | ',' => Self::Move(MoveKey::Left),
                'e' | '.' => Self::Move(MoveKey::Right),
                // Without Shift, too.
                '+' | '=' => Self::Faster,
                '-' | '_' => Self::Slower,
                ' ' => Self::Stop,
                'h' => Self::Hold,
                'r' => Self::Reset,
                _ => return None,
            },
            _ => return None,
        };
        Some(key)
    }
}

/// Whether a key was let go.
pub(crate) fn is_release(event: &KeyEvent) -> bool {
    event.kind == KeyEventKind::Release
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_direction_has_an_arrow_or_a_sign_and_a_letter_in_either_case() {
        let of = |code| DriveKey::of(&KeyEvent::new(code, KeyModifiers::NONE));
        for (letter, other, direction) in [
            ('w', KeyCode::Up, MoveKey::Ahead),
            ('s', KeyCode::Down, MoveKey::Back),
            ('a', KeyCode::Left, MoveKey::TurnLeft),
            ('d', KeyCode::Right, MoveKey::TurnRight),
            ('q', KeyCode::Char(','), MoveKey::Left),
            ('e', KeyCode::Char('.'), MoveKey::Right),
        ] {
            for code in [KeyCode::Char(letter), KeyCode::Char(letter.to_ascii_uppercase()), other] {
                assert_eq!(of(code), Some(DriveKey::Move(direction)), "{code:?}");
            }
            assert_eq!(direction.opposite().opposite(), direction);
        }
        assert_eq!(of(KeyCode::Char('x')), None);
    }

    #[test]
    fn control_c_leaves_and_no_other_key_with_control_does_anything() {
        let with_control = |letter| DriveKey::of(&KeyEvent::new(KeyCode::Char(letter), KeyModifiers::CONTROL));
        assert_eq!(with_control('c'), Some(DriveKey::Leave));
        assert_eq!(with_control('w'), None);
    }
}
