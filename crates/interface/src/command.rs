//! The gait parameters: turn, speed, step extension and sidestep.

/// The gait parameters in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// `α`: change of heading per full step (rad), positive to the left.
    pub turn: f64,
    /// `c`: speed as a multiple of the nominal half-step's (-).
    pub speed: f64,
    /// `β`: step extension (rad), positive for longer steps; far below zero steps go backward.
    pub extension: f64,
    /// `γ`: sidestep per full step (rad), positive to the left.
    pub sidestep: f64,
}

/// A change of gait parameters; a parameter that is `None` stays as it is. The set is granted or refused as one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GaitChange {
    /// `α`: change of heading per full step (rad), positive to the left.
    pub turn: Option<f64>,
    /// `c`: speed as a multiple of the nominal half-step's (-).
    pub speed: Option<f64>,
    /// `β`: step extension (rad), positive for longer steps; far below zero steps go backward.
    pub extension: Option<f64>,
    /// `γ`: sidestep per full step (rad), positive to the left.
    pub sidestep: Option<f64>,
}

impl Command {
    /// Straight ahead, at the nominal half-step's speed and length.
    pub const NOMINAL: Command = Command { turn: 0.0, speed: 1.0, extension: 0.0, sidestep: 0.0 };
}

impl GaitChange {
    /// Every parameter stays as it is.
    pub const NONE: GaitChange = GaitChange { turn: None, speed: None, extension: None, sidestep: None };
}

impl From<Command> for GaitChange {
    /// Requests all parameters.
    fn from(command: Command) -> Self {
        Self {
            turn: Some(command.turn),
            speed: Some(command.speed),
            extension: Some(command.extension),
            sidestep: Some(command.sidestep),
        }
    }
}
