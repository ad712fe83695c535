//! The commands, one per file.

mod arrival;
mod bench;
mod check;
mod config_options;
mod connect;
mod controller;
mod destination;
mod doctor;
mod engine;
mod export;
mod import;
mod options;
mod paper;
mod paper_files;
mod paper_search;
mod plant;
mod plot;
mod replay;
mod robots;
mod send;
mod status;
mod stream;
mod synthesize;
mod teleop;
mod view;
mod walk;
mod watch;

use clap::{Parser, Subcommand};

use crate::error::CliError;
use crate::status::Status;

/// Walk a biped from one nominal half-step, and modify the gait online
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
pub(crate) struct Halfstep {
    #[command(subcommand)]
    command: HalfstepCommand,
    /// Print results as JSON on stdout, and errors as {"error": …}, too
    // Left out, its place in each help is the number of subcommands.
    #[arg(long, global = true, display_order = 14)]
    json: bool,
    /// Tell nothing on stderr but errors: no progress, no modes, no advice
    #[arg(long, short, global = true, display_order = 15)]
    quiet: bool,
}

#[derive(Debug, Subcommand)]
enum HalfstepCommand {
    Walk(walk::WalkArgs),
    Controller(controller::ControllerArgs),
    Plant(plant::PlantArgs),
    Send(send::SendArgs),
    Stream(stream::StreamArgs),
    Teleop(teleop::TeleopArgs),
    View(view::ViewArgs),
    Status(status::StatusArgs),
    Watch(watch::WatchArgs),
    Synthesize(synthesize::SynthesizeArgs),
    Paper(paper::PaperArgs),
    Check(check::CheckArgs),
    Doctor(doctor::DoctorArgs),
    Bench(bench::BenchArgs),
    Export(export::ExportArgs),
    Import(import::ImportArgs),
    Robots(robots::RobotsArgs),
    Plot(plot::PlotArgs),
    Replay(replay::ReplayArgs),
}

impl Halfstep {
    /// Whether results are to be printed as JSON.
    pub(crate) fn prints_json(&self) -> bool {
        self.json
    }

    /// Whether only errors are to be told.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

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
            HalfstepCommand::Teleop(args) => args.run(json),
            HalfstepCommand::View(args) => args.run(json),
            HalfstepCommand::Status(args) => args.run(json),
            HalfstepCommand::Watch(args) => args.run(json),
            HalfstepCommand::Synthesize(args) => args.run(json),
            HalfstepCommand::Paper(args) => args.run(json),
            HalfstepCommand::Check(args) => args.run(json),
            HalfstepCommand::Doctor(args) => args.run(json),
            HalfstepCommand::Bench(args) => args.run(json),
            HalfstepCommand::Export(args) => args.run(json),
            HalfstepCommand::Import(args) => args.run(json),
            HalfstepCommand::Robots(args) => args.run(json),
            HalfstepCommand::Plot(args) => args.run(json),
            HalfstepCommand::Replay(args) => args.run(json),
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use expect_test::expect_file;

    use super::Halfstep;

    #[test]
    fn the_command_line_is_consistent() {
        Halfstep::command().debug_assert();
    }

    /// The help of a command and of all commands below it that users see.
    fn help(command: &mut clap::Command, path: &str, text: &mut String) {
        *text += &format!("$ {path} --help\n{}\n", command.render_long_help());
        for below in command.get_subcommands_mut().filter(|below| !below.is_hide_set()) {
            help(below, &format!("{path} {}", below.get_name()), text);
        }
    }

    #[test]
    fn the_help_of_every_command_is_the_pinned_text() {
        let mut text = String::new();
        let mut halfstep = Halfstep::command().term_width(100);
        halfstep.build();
        help(&mut halfstep, "halfstep", &mut text);
        expect_file!["../../tests/help.txt"].assert_eq(&text);
    }
}
