//! What people type: the commands of `halfstep`.
//!
//! One command per file in [`command`]; the two loops are [`run_controller`] and [`run_plant`]. The crates that these tie
//! together do not know each other: what one says is put into the other's words in [`exchange`].

pub mod advisor;
pub mod bench_page;
pub mod clerk;
pub mod command;
pub mod configuration;
pub mod engine;
pub mod exchange;
pub mod failure;
pub mod html;
pub mod import;
pub mod in_command;
pub mod inbox;
pub mod interrupt;
pub mod loop_times;
pub mod mjcf;
pub mod operator;
pub mod paper;
pub mod picture;
pub mod process;
pub mod progress;
pub mod python_messages;
pub mod realtime;
pub mod record;
pub mod replay;
pub mod run_controller;
pub mod run_log;
pub mod run_plant;
pub mod script;
pub mod summary;
pub mod turns;
pub mod urdf;
pub mod voice;
pub mod watched;
pub mod words;

use std::process::ExitCode;

use clap::Parser;
use tracing_subscriber::EnvFilter;

/// Does what the command line says. The whole program: `main` is nothing else.
///
/// Exit codes: 0 it is fine, 1 it failed or the robot fell, 2 the command line or an input file is wrong.
pub fn run() -> ExitCode {
    let halfstep = match command::Halfstep::try_parse() {
        Ok(halfstep) => halfstep,
        Err(error) => {
            // Nobody is left to tell when even this cannot be written.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new("warn"));
    tracing_subscriber::fmt().with_writer(std::io::stderr).with_env_filter(filter).init();
    match halfstep.run() {
        Ok(outcome) => outcome.into(),
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}
