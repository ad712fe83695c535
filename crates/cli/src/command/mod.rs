//! The commands, one per file.

mod bench;
mod check;
mod config_options;
mod controller;
mod engine;
mod export;
mod import;
mod options;
mod paper;
mod plant;
mod plot;
mod replay;
mod send;
mod stream;
mod synthesize;
mod walk;

use clap::{Parser, Subcommand};

use crate::error::CliError;
use crate::status::Status;

/// Online gait modification for a 20-joint biped.
#[derive(Debug, Parser)]
#[command(version, about)]
pub(crate) struct Halfstep {
    #[command(subcommand)]
    command: HalfstepCommand,
    /// Print results as JSON on stdout
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum HalfstepCommand {
    Walk(walk::WalkArgs),
    Controller(controller::ControllerArgs),
    Plant(plant::PlantArgs),
    Send(send::SendArgs),
    Stream(stream::StreamArgs),
    Synthesize(synthesize::SynthesizeArgs),
    Paper(paper::PaperArgs),
    Check(check::CheckArgs),
    Bench(bench::BenchArgs),
    Export(export::ExportArgs),
    Import(import::ImportArgs),
    Plot(plot::PlotArgs),
    Replay(replay::ReplayArgs),
}

impl Halfstep {
    /// Runs the command.
    ///
    /// # Errors
    /// The command line or an input file is wrong, or the command failed.
    pub(crate) fn run(self) -> Result<Status, CliError> {
        let json = self.json;
        match self.command {
            HalfstepCommand::Walk(args) => args.run(json),
            HalfstepCommand::Controller(args) => args.run(json),
            HalfstepCommand::Plant(args) => args.run(json),
            HalfstepCommand::Send(args) => args.run(json),
            HalfstepCommand::Stream(args) => args.run(json),
            HalfstepCommand::Synthesize(args) => args.run(json),
            HalfstepCommand::Paper(args) => args.run(json),
            HalfstepCommand::Check(args) => args.run(json),
            HalfstepCommand::Bench(args) => args.run(json),
            HalfstepCommand::Export(args) => args.run(),
            HalfstepCommand::Import(args) => args.run(json),
            HalfstepCommand::Plot(args) => args.run(json),
            HalfstepCommand::Replay(args) => args.run(json),
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        super::Halfstep::command().debug_assert();
    }
}
