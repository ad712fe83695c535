//! The command line of `halfstep`: what users type and read.
//!
//! One command per file in `command`: its options, and what it prints. The crates below do the work. `process` runs
//! other `halfstep` processes, `error` and `status` are how a command ends, `output` prints and writes.

mod command;
mod error;
mod instance_status;
mod messages;
mod observed_changes;
mod output;
mod output_folder;
mod plotted_run;
mod process;
mod progress;
mod recorded_floor;
mod robot_folder;
mod state_line;
mod status;
mod walk_summary;
mod work_progress;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};

pub use crate::error::CliError;

/// The command line as clap knows it: every command with its options and its help, for completions and manual pages.
pub fn command_line() -> clap::Command {
    command::Halfstep::command()
}

/// Runs the command line: the whole program, which `main` calls.
///
/// Exit codes: 0 success; 1 failure, a refusal, a fall or a latched fault of the robot; 2 the command line or an input
/// file is wrong.
pub fn run() -> ExitCode {
    let halfstep = match command::Halfstep::try_parse() {
        Ok(halfstep) => halfstep,
        Err(error) => {
            if error.use_stderr() && std::env::args_os().any(|word| word == "--json") {
                let text = error.to_string();
                // What cannot be printed here can be printed nowhere.
                let _ = output::print_json(&CliError::bad_input(text.trim_end()));
            }
            // If even this cannot be written, nobody reads it.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    messages::begin(halfstep.is_quiet());
    let json = halfstep.prints_json();
    match halfstep.run() {
        Ok(status) => status.into(),
        Err(error) => {
            output::print_error(json, &error);
            error.exit_code()
        }
    }
}
