//! What goes to and from a page, as JSON texts over its socket.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::floor_cells::FloorPiece;
use crate::robot_drawing::RobotDrawing;
use crate::view_frame::ViewFrame;

/// A message to a page: `{"live": …}`, `{"frame": …}` and so on.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ToPage<'a> {
    /// A robot is running.
    Live {
        /// Which one, in words.
        instance: &'a str,
        /// Control periods per second (Hz).
        rate_hz: u32,
        /// What it looks like.
        robot: &'a RobotDrawing,
    },
    /// There is none to be seen.
    Waiting {
        /// Why, in words.
        why: &'a str,
    },
    /// The newest instant of the robot that is running.
    Frame(&'a ViewFrame),
    /// Who drives: the page itself, and whether anybody does.
    Driver {
        /// This page drives.
        you: bool,
        /// Some page does.
        taken: bool,
    },
    /// What became of a request of a page, in words.
    Answer {
        /// `accepted`, `limited`, `refused` or `push`.
        verdict: &'a str,
        /// What became of it, in words.
        text: &'a str,
    },
    /// A recorded run begins. Its frames and events follow.
    Run {
        /// Which of the runs that are shown.
        index: usize,
        /// Its name.
        name: &'a str,
        /// What its robot looks like.
        robot: &'a RobotDrawing,
        /// How long it lasts (s).
        duration: f64,
        /// How many frames follow.
        frames: usize,
    },
    /// The next frames of a recorded run.
    Frames {
        /// Of which run.
        index: usize,
        /// In the order of their times.
        frames: &'a [ViewFrame],
    },
    /// The floor near the robot, in place of what was told of it before.
    Floor {
        /// Of which run.
        index: usize,
        /// Without overlap; none if it is a plane.
        pieces: &'a [FloorPiece],
    },
    /// What happened in a recorded run.
    Events {
        /// In which run.
        index: usize,
        /// In the order of their times.
        events: &'a [RunNote],
    },
}

/// Something that happened in a recorded run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunNote {
    /// When (s).
    pub t: f64,
    /// `accepted`, `limited`, `refused`, `push` or `fall`.
    pub kind: &'static str,
    /// What, in words.
    pub text: String,
}

/// A message from a page. Anything else is ignored.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FromPage {
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
pub struct AskedPush {
    /// Index of the joint that carries the pushed link.
    pub joint: u64,
    /// Force times duration (N·s): ahead, to the left and up, as the robot faces.
    pub impulse: [f64; 3],
    /// How long it lasts (s).
    pub lasts_s: f64,
}

impl ToPage<'_> {
    /// The message as a text.
    pub fn text(&self) -> Arc<str> {
        // Numbers that JSON does not have become null; there is nothing else that could fail.
        serde_json::to_string(self).unwrap_or_default().into()
    }
}
