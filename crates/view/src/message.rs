//! What goes to and from a page, as JSON texts over its socket.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::robot_drawing::RobotDrawing;
use crate::view_frame::ViewFrame;

/// A message to a page: `{"live": …}`, `{"frame": …}` and so on.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ToPage<'a> {
    /// A robot is running.
    Live { instance: &'a str, rate_hz: u32, robot: &'a RobotDrawing },
    /// There is none to be seen.
    Waiting { why: &'a str },
    /// The newest instant of the robot that is running.
    Frame(&'a ViewFrame),
    /// Who drives: the page itself, and whether anybody does.
    Driver { you: bool, taken: bool },
    /// What became of a request of a page, in words.
    Answer { verdict: &'a str, text: &'a str },
    /// A recorded run begins. Its frames and events follow.
    Run { index: usize, name: &'a str, robot: &'a RobotDrawing, duration: f64, frames: usize },
    /// The next frames of a recorded run.
    Frames { index: usize, frames: &'a [ViewFrame] },
    /// What happened in a recorded run.
    Events { index: usize, events: &'a [RunNote] },
}

/// Something that happened in a recorded run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct RunNote {
    /// When (s).
    pub(crate) t: f64,
    /// `accepted`, `limited`, `refused`, `push` or `fall`.
    pub(crate) kind: &'static str,
    /// What, in words.
    pub(crate) text: String,
}

/// A message from a page. Anything else is ignored.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum FromPage {
    /// The page wants to drive, or no longer.
    Drive(bool),
    /// The page that drives is alive.
    Beat,
    /// A command as a line of `halfstep stream` has it.
    Command(Value),
    /// The robot is to stop: any page may ask for that.
    Stop,
    /// The simulated robot is to be pushed.
    Push(AskedPush),
}

/// A push as a page asks for it.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AskedPush {
    /// Index of the joint that carries the pushed link.
    pub(crate) joint: u64,
    /// Force times duration (N·s): ahead, to the left and up, as the robot faces.
    pub(crate) impulse: [f64; 3],
    pub(crate) lasts_s: f64,
}

impl ToPage<'_> {
    /// The message as a text.
    pub(crate) fn text(&self) -> Arc<str> {
        // Numbers that JSON does not have become null; there is nothing else that could fail.
        serde_json::to_string(self).unwrap_or_default().into()
    }
}
