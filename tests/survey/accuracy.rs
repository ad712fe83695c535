//! Accuracy: what larger integration steps err, in our plant and in MuJoCo.
//!
//! Each engine walks by itself, controlled, in steps of 10 µs: its reference, since each has its own contacts. From
//! places of that walk the same setpoints are played again without a controller, in larger steps, and after some time
//! it is told how far the robot is from the reference: the root of the mean square over all places. As committed our
//! plant must not err more than MuJoCo does in steps of a millisecond.

use interface::Setpoint;
use std::path::PathBuf;

use halfstep_tests::mechanism;
use halfstep_tests::replaying::{Apart, REFERENCE_STEPS, Reference};
use halfstep_tests::walking::{PERIOD, controller_parameters, plant_parameters};
use model::{Joint, Mechanism};
use node::engine::EngineSetup;
use plant::{Disturbances, Plant, RobotState};
use serde_json::{Value, json};

use crate::mujoco::{self, Outside};
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Places of the walk from which it is played again
    #[arg(long, default_value_t = 20)]
    starts: usize,
    /// Print it as JSON
    #[arg(long)]
    json: bool,
    /// Write what is played in MuJoCo, for others to time it
    #[arg(long, value_name = "FILE")]
    played: Option<PathBuf>,
}

/// Integration steps per control period, of both engines.
const STEPS: [u32; 4] = [1, 2, 4, 8];
/// The walk is steady by then (control periods).
const FIRST: usize = 1000;
/// From place to place: no divisor of a half-step, so that all its phases come (control periods).
const EVERY: usize = 137;
/// How much of what follows each place is written (control periods).
const PLAYED: usize = 200;
/// When errors are told (control periods): the last is a half-step.
const AFTER: [usize; 3] = [100, 200, 600];

/// An engine with so many integration steps per control period.
struct Row {
    engine: &'static str,
    steps: u32,
    apart: [Apart; AFTER.len()],
}

pub(crate) fn survey(options: &Options) -> bool {
    let mechanism = mechanism();
    let starts: Vec<usize> = (0..options.starts).map(|number| FIRST + number * EVERY).collect();
    let periods = FIRST + options.starts * EVERY + AFTER[AFTER.len() - 1] + 1;

    let walk = Reference::walk(&mechanism, periods, Plant::step);
    let ours = STEPS.map(|steps| ours(&mechanism, &walk, &starts, steps));

    let start = mujoco::start(&mechanism, &controller_parameters());
    let start = RobotState::on_right_foot(&start, 0.0);
    let mut outside = Outside::take_over(setup(&mechanism, &start, REFERENCE_STEPS));
    let walk = Reference::walk(&mechanism, periods, |plant, setpoint| outside.step(plant, setpoint));
    let mujocos = STEPS.map(|steps| mujocos(&mechanism, &walk, &starts, steps));
    if let Some(file) = &options.played {
        let played = played(&mechanism, &walk, &starts);
        std::fs::write(file, played.to_string()).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    }

    let rows = || ours.iter().chain(&mujocos);
    if options.json {
        println!("{}", rows().map(Row::json).collect::<Value>());
    } else {
        println!("errors of joints [mrad], place [mm] and angle [mrad] of the trunk after {AFTER:?} ms");
        let header = ["engine", "steps", "joints", "", "", "place", "", "", "angle", "", ""];
        table::print(&header, &rows().map(Row::text).collect::<Vec<_>>());
    }
    let committed = ours.iter().find(|row| row.steps == plant_parameters().steps_per_period);
    committed.is_some_and(|row| row.errs_no_more_than(&mujocos[0]))
}

/// Our plant's errors.
fn ours(mechanism: &Mechanism, walk: &Reference, starts: &[usize], steps: u32) -> Row {
    let apart = walk.apart(mechanism, starts, AFTER, |plant| {
        let mut plant = plant.clone();
        plant.set_steps_per_period(steps);
        (plant, Plant::step)
    });
    Row { engine: "ours", steps, apart }
}

/// MuJoCo's errors.
fn mujocos(mechanism: &Mechanism, walk: &Reference, starts: &[usize], steps: u32) -> Row {
    let apart = walk.apart(mechanism, starts, AFTER, |plant| {
        let mut outside = Outside::take_over(setup(mechanism, &plant.robot, steps));
        (plant.clone(), move |plant: &mut Plant, setpoint: &Setpoint| outside.step(plant, setpoint))
    });
    Row { engine: "MuJoCo", steps, apart }
}

/// MuJoCo's robot in a state.
fn setup(mechanism: &Mechanism, robot: &RobotState, steps: u32) -> EngineSetup {
    let parameters = plant::PlantParameters { steps_per_period: steps, ..plant_parameters() };
    EngineSetup::new(mechanism, &parameters, &Disturbances::default(), robot, 0, PERIOD)
        .expect("tiles that are not too small")
}

/// For each place what an engine is told, and the setpoints that follow: rows of angles, rates and torques.
fn played(mechanism: &Mechanism, walk: &Reference, starts: &[usize]) -> Value {
    let rows = |start: usize| -> Vec<[[f64; Joint::COUNT]; 3]> {
        let setpoints = walk.setpoints[start..start + PLAYED].iter();
        setpoints.map(|setpoint| [setpoint.angles.0, setpoint.rates.0, setpoint.feed_forward.0]).collect()
    };
    starts
        .iter()
        .map(|&start| json!({ "told": setup(mechanism, &walk.plants[start].robot, 1), "setpoints": rows(start) }))
        .collect()
}

impl Row {
    /// In any respect, at any time.
    fn errs_no_more_than(&self, other: &Row) -> bool {
        std::iter::zip(&self.apart, &other.apart).all(|(mine, theirs)| {
            mine.joints <= theirs.joints && mine.place <= theirs.place && mine.turn <= theirs.turn
        })
    }

    fn json(&self) -> Value {
        let Self { engine, steps, apart } = self;
        let of = |value: fn(&Apart) -> f64| apart.iter().map(value).collect::<Vec<f64>>();
        json!({
            "engine": engine,
            "steps_per_period": steps,
            "after_periods": AFTER,
            "joints_rad": of(|apart| apart.joints),
            "trunk_m": of(|apart| apart.place),
            "trunk_rad": of(|apart| apart.turn),
        })
    }

    fn text(&self) -> Vec<String> {
        let Self { engine, steps, apart } = self;
        let mut text = vec![(*engine).to_owned(), steps.to_string()];
        for value in [|apart: &Apart| apart.joints, |apart: &Apart| apart.place, |apart: &Apart| apart.turn] {
            text.extend(apart.iter().map(|apart| format!("{:.3}", 1e3 * value(apart))));
        }
        text
    }
}
