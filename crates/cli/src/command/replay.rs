//! `halfstep replay`: re-runs the controller on recorded inputs, and compares the setpoints.

use std::path::PathBuf;

use node::replay::replay;

use crate::error::CliError;
use crate::output::print;
use crate::status::Status;

/// Re-run the controller on the recorded inputs, and report the first setpoint that differs in any bit
///
/// Exit code 0: all recorded setpoints are the same; if the recording is truncated, it says up to when. Exit code 1:
/// one differs, ticks or requests are missing in between, or no setpoint was recorded.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ReplayArgs {
    /// A recording, or the folder of a run
    #[arg(value_name = "RUN")]
    run: PathBuf,
}

impl ReplayArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let outcome = replay(&self.run)?;
        print(json, &outcome)?;
        Ok(Status::success_if(outcome.is_identical()))
    }
}
