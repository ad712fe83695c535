//! The command line of `halfstep`: what users type and read.
//!
//! One command per file in `command`: its options, and what it prints. The crates below do the work. `process` runs
//! other `halfstep` processes, `error` and `status` are how a command ends, `output` prints and writes.

mod command;
mod error;
mod output;
mod process;
mod progress;
mod robot_folder;
mod status;
mod walk_summary;

use std::process::ExitCode;

use clap::Parser;
use tracing_subscriber::EnvFilter;

pub use crate::error::CliError;

/// Runs the command line: the whole program, which `main` calls.
///
/// Exit codes: 0 success, 1 failure, a fall or a latched fault of the robot, 2 the command line or an input file is
/// wrong.
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
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new("warn"));
    // Its own way to report that stderr cannot be written is to write to stderr, which panics.
    tracing_subscriber::fmt().with_writer(std::io::stderr).with_env_filter(filter).log_internal_errors(false).init();
    let json = halfstep.prints_json();
    match halfstep.run() {
        Ok(status) => status.into(),
        Err(error) => {
            output::print_error(json, &error);
            error.exit_code()
        }
    }
}
