//! `halfstep replay`: whether the controller would do the same again.

use std::path::PathBuf;

use super::print;
use crate::failure::{Failure, Outcome};
use crate::replay::replay;

/// Feed the controller what was recorded, and compare its setpoints with the recorded ones, bit for bit
#[derive(Clone, Debug, clap::Args)]
pub struct Replay {
    /// A recording, or the folder of a run
    #[arg(value_name = "RUN")]
    run: PathBuf,
}

impl Replay {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let outcome = replay(&self.run)?;
        print(json, &outcome)?;
        Ok(Outcome::fine_if(outcome.is_identical()))
    }
}
