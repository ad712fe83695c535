//! `halfstep teleop`: a robot in a terminal, with keys that drive it.

use std::time::Duration;

use node::interrupt::Interrupt;
use teleop::{Teleop, TeleopError};
use wire::ObserverPorts;

use super::connect::patiently;
use super::options::{InstanceOption, command_timeout};
use crate::error::CliError;
use crate::output::print;
use crate::status::Status;

/// Drive a running robot with keys, and see its state in one screen of the terminal
///
/// Hold a key to move: arrows or W A S D ahead, back and turning, Q E aside; + and - change the pace. Space stops, H
/// stops in stride, R resets after a fault, Esc leaves and stops the robot. A terminal of the kitty protocol tells when
/// a key is let go, and the robot stops at once; in others it stops when no repeat of the key has come for the age
/// limit. The screen says which it is. Keys outrank scripts and programs.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct TeleopArgs {
    #[command(flatten)]
    instance: InstanceOption,
    /// The robot stops when no sign of life has come for this long of the controller's time, e.g. 500ms [default:
    /// 800ms, but 12s in lockstep, which passes faster]
    #[arg(long, value_name = "DURATION", value_parser = command_timeout, allow_hyphen_values = true)]
    age_limit: Option<Duration>,
}

impl TeleopArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        teleop::require_terminal()?;
        let interrupt = Interrupt::listen()?;
        let instance = self.instance.instance()?;
        drop(patiently(&instance, || ObserverPorts::connect(&instance))?);
        let summary = Teleop { instance, age_limit: self.age_limit }.run(|| interrupt.is_raised())?;
        print(json, &summary)?;
        Ok(Status::Success)
    }
}

impl From<TeleopError> for CliError {
    fn from(error: TeleopError) -> Self {
        match error {
            TeleopError::NoTerminal(_) => Self::bad_input(error),
            TeleopError::Connect(error) => error.into(),
            error => Self::new(error),
        }
    }
}
