//! What a page has done to its robot, as the files by which `halfstep walk` repeats it bit for bit.

use std::fmt::Write;

use plant::Push;
use serde_json::Value;

/// The commands and pushes of a walk so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Session {
    /// For `--commands`: one line each, with its time.
    pub commands: String,
    /// For `--disturbances`.
    pub disturbances: String,
}

impl Session {
    /// Adds a command that was given for a time (s).
    pub(crate) fn add_command(&mut self, time: f64, mut command: Value) {
        command["t"] = time.into();
        self.commands += &format!("{command}\n");
    }

    /// Adds a push that has begun.
    pub(crate) fn add_push(&mut self, push: &Push) {
        let Push { link, impulse, start, duration } = push;
        let [x, y, z]: [f64; 3] = (*impulse).into();
        let link = link.link_name().unwrap_or_default();
        // Writing to a text cannot fail. Digits as they are needed for the same bits.
        let _ = write!(
            self.disturbances,
            "[[push]]\nat_s = {start:?}\nlasts_s = {duration:?}\nimpulse_n_s = [{x:?}, {y:?}, {z:?}]\n\
             link = \"{link}\"\n"
        );
    }
}
