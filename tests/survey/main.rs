//! The long acceptance runs: what walks, what falls, and by how little.
//!
//! `cargo run --release -p halfstep-survey -- NAME`, with `--help` for what can be chosen. Controller and plant walk in
//! lockstep in one process, on all cores, with the committed configuration; a seed decides everything. Each survey
//! prints a table and ends with exit code 1 if something that must not happen happened.

#[cfg(feature = "mujoco")]
mod accuracy;
#[cfg(feature = "mujoco")]
mod agreement;
mod asked;
mod capturability;
mod cores;
#[cfg(all(feature = "mujoco", feature = "processes"))]
mod directions;
mod doctor;
mod faults;
mod files;
#[cfg(feature = "mujoco")]
mod goals;
mod grid;
#[cfg(all(feature = "mujoco", feature = "processes"))]
mod imported;
#[cfg(feature = "processes")]
mod kill;
mod margins;
#[cfg(feature = "mujoco")]
mod mujoco;
#[cfg(feature = "mujoco")]
mod mujoco_pushes;
mod needs;
mod playback;
mod pushes;
mod resets;
#[cfg(all(feature = "mujoco", feature = "processes"))]
mod robots;
mod sensor_variations;
mod single;
mod spoiling;
mod start_stop;
#[cfg(feature = "processes")]
mod starvation;
mod streams;
mod table;
mod tuning;
mod variations;
#[cfg(feature = "mujoco")]
mod velocities;
mod watched;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(about, long_about = None)]
struct Arguments {
    #[command(subcommand)]
    survey: Survey,
}

/// One survey each, one file each.
#[derive(Subcommand)]
enum Survey {
    /// Speed, turn and extension, each alone, over more than is granted
    Single(single::Options),
    /// Speed, turn and extension in every combination of a grid
    Grid(grid::Options),
    /// Random requests, one after the other
    Streams(streams::Options),
    /// Random sequences of start, walk, change, stop, hold, start again
    StartStop(start_stop::Options),
    /// The largest push survived, by phase of the half-step and direction
    Pushes(pushes::Options),
    /// Whether the report is right about who can still be kept from falling
    Capturability(capturability::Options),
    /// Other floors, masses, loads, slopes and delays than the controller believes
    Variations(variations::Options),
    /// Falls to every side, each followed by a reset on the robot's feet, in a stand and in other postures
    Resets(resets::Options),
    /// The doctor with the robots in the box, which are healthy, and with planted faults, which it must name
    Doctor(doctor::Options),
    /// The pictures of docs/tuning.md
    Tuning(tuning::Options),
    /// Wrong sensors: every kind, group and duration, walking and standing; and false alarms of clean walks
    Faults(faults::Options),
    /// Compensation needed: the paper's leans and ours, and which walks fall without it
    Needs(needs::Options),
    /// Spoilt files through the command line: no panic, nothing slow, nothing large
    Files(files::Options),
    /// The predicted least margin of half-steps against the measured one
    Margins(margins::Options),
    /// `kill -9` of every process in every phase; a stop during every kind of flood. In real time, with the halfstep
    /// program beside this one; --kills 1000 for acceptance
    #[cfg(feature = "processes")]
    Kill(kill::Options),
    /// Public robots, imported from their URDFs, in our plant and in MuJoCo: the table of docs/robots.md
    #[cfg(all(feature = "mujoco", feature = "processes"))]
    Robots(robots::Options),
    /// The fastest walk of each direction, kept up by the built-in robot or by public ones
    #[cfg(all(feature = "mujoco", feature = "processes"))]
    Directions(directions::Options),
    /// What is granted, walked in MuJoCo
    #[cfg(feature = "mujoco")]
    Mujoco(mujoco::Options),
    /// The largest push survived in MuJoCo
    #[cfg(feature = "mujoco")]
    MujocoPushes(mujoco_pushes::Options),
    /// Random velocities in every direction: no fall, and what is granted is walked
    #[cfg(feature = "mujoco")]
    Velocities(velocities::Options),
    /// Random goals, or lists of footsteps: no fall, and the robot arrives where and when it was asked to
    #[cfg(feature = "mujoco")]
    Goals(goals::Options),
    /// Random scenarios, half of them hard, in our plant and in MuJoCo: whether both fall or walk, and how near their
    /// ZMP is
    #[cfg(feature = "mujoco")]
    Agreement(agreement::Options),
    /// Error of larger integration steps, in our plant and in MuJoCo
    #[cfg(feature = "mujoco")]
    Accuracy(accuracy::Options),
}

fn main() -> ExitCode {
    let passed = match &Arguments::parse().survey {
        Survey::Single(options) => single::survey(options),
        Survey::Grid(options) => grid::survey(options),
        Survey::Streams(options) => streams::survey(options),
        Survey::StartStop(options) => start_stop::survey(options),
        Survey::Pushes(options) => pushes::survey(options),
        Survey::Capturability(options) => capturability::survey(options),
        Survey::Resets(options) => resets::survey(options),
        Survey::Doctor(options) => doctor::survey(options),
        Survey::Tuning(options) => tuning::survey(options),
        Survey::Variations(options) => variations::survey(options),
        Survey::Faults(options) => faults::survey(options),
        Survey::Needs(options) => needs::survey(options),
        Survey::Files(options) => files::survey(options),
        Survey::Margins(options) => margins::survey(options),
        #[cfg(feature = "processes")]
        Survey::Kill(options) => kill::survey(options),
        #[cfg(all(feature = "mujoco", feature = "processes"))]
        Survey::Robots(options) => robots::survey(options),
        #[cfg(all(feature = "mujoco", feature = "processes"))]
        Survey::Directions(options) => directions::survey(options),
        #[cfg(feature = "mujoco")]
        Survey::Mujoco(options) => mujoco::survey(options),
        #[cfg(feature = "mujoco")]
        Survey::MujocoPushes(options) => mujoco_pushes::survey(options),
        #[cfg(feature = "mujoco")]
        Survey::Velocities(options) => velocities::survey(options),
        #[cfg(feature = "mujoco")]
        Survey::Goals(options) => goals::survey(options),
        #[cfg(feature = "mujoco")]
        Survey::Agreement(options) => agreement::survey(options),
        #[cfg(feature = "mujoco")]
        Survey::Accuracy(options) => accuracy::survey(options),
    };
    if passed { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
