//! A robot in a terminal: its state in one screen, and keys that drive it.
//!
//! Hold a key and the robot moves; let go and it stops. Terminals of the kitty protocol tell when a key is let go.
//! Others only repeat the key that is held, so it counts as held until no repeat has come for a while. In both cases
//! each sign of life becomes a heartbeat of a stream of the source `teleop`: when none comes any more, the controller
//! stops the robot after the stream's age limit, whatever has become of the terminal, the connection or this process.
//!
//! * [`session`]: everything until the person leaves.
//! * `terminal` and `hangup`: the terminal and its keys; it is left as it was found, also after a panic, and the
//!   process ends with it.
//! * `drive_key` and `held_keys`: what keys mean, and which are held.
//! * `drive_pace`: how fast a held key moves the robot.
//! * `observed`: what the controller's reports tell.
//! * `screen` and `path_map`: what is drawn of it.

mod drive_key;
mod drive_pace;
mod error;
mod hangup;
mod held_keys;
mod observed;
mod path_map;
mod screen;
pub mod session;
mod terminal;

pub use error::TeleopError;
pub use session::{Teleop, TeleopSummary};
pub use terminal::require_terminal;
