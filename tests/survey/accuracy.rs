//! Accuracy: what larger integration steps err and cost, in our plant and in MuJoCo.
//!
//! Each engine walks by itself, controlled, in steps of 10 µs: its reference, since each has its own contacts. From places of
//! that walk the same setpoints are played again without a controller, in larger steps, and after some time it is told how far
//! the robot is from the reference: the root of the mean square over all places. Servos reach for the same setpoints in all.

use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

use halfstep::engine::Setup;
use halfstep_tests::mechanism;
use halfstep_tests::replaying::{Apart, REFERENCE_STEPS, Reference};
use halfstep_tests::walking::{PERIOD, controller_parameters, plant_parameters};
use model::Mechanism;
use plant::{Disturbances, Plant, RobotState, Setpoint};
use serde_json::{Value, json};

use crate::mujoco::{self, Outside};
use crate::table;

#[derive(clap::Args)]
pub struct Options {
    /// Places of the walk from which it is played again
    #[arg(long, default_value_t = 20)]
    starts: usize,
    /// Rounds of which the fastest counts
    #[arg(long, default_value_t = 5)]
    rounds: u32,
    /// Print it as JSON
    #[arg(long)]
    json: bool,
    /// Write what is played in MuJoCo, for others to time it
    #[arg(long, value_name = "FILE")]
    mujoco_out: Option<PathBuf>,
}

/// Integration steps per control period.
const OURS: [u32; 4] = [1, 2, 4, 8];
const MUJOCOS: [u32; 3] = [1, 4, REFERENCE_STEPS];
/// The walk is steady by then [control periods].
const FIRST: usize = 1000;
/// From place to place: no divisor of a half-step, so that all its phases come [control periods].
const EVERY: usize = 137;
/// How long each place's part is timed [control periods].
const TIMED: usize = 200;
/// When errors are told [control periods]: the last is a half-step.
const AFTER: [usize; 3] = [100, 200, 600];

/// An engine with so many integration steps per control period.
struct Row {
    engine: &'static str,
    steps: u32,
    apart: [Apart; AFTER.len()],
    /// Of a control period, sensors included [s].
    cost: Option<f64>,
}

pub fn survey(options: &Options) -> bool {
    let mechanism = mechanism();
    let starts: Vec<usize> = (0..options.starts).map(|number| FIRST + number * EVERY).collect();
    let periods = FIRST + options.starts * EVERY + AFTER[AFTER.len() - 1] + 1;

    let walk = Reference::walk(&mechanism, periods, Plant::step);
    let mut rows: Vec<Row> = OURS.map(|steps| ours(&mechanism, &walk, &starts, steps)).into();
    for _ in 0..options.rounds {
        for row in &mut rows {
            let cost = cost(&walk, &starts, row.steps);
            row.cost = Some(row.cost.map_or(cost, |least| least.min(cost)));
        }
    }

    let start = mujoco::start(&mechanism, &controller_parameters());
    let start = RobotState::on_right_foot(&start, 0.0);
    let mut outside = Outside::take_over(setup(&mechanism, &start, REFERENCE_STEPS));
    let walk = Reference::walk(&mechanism, periods, |plant, setpoint| outside.step(plant, setpoint));
    rows.extend(MUJOCOS.map(|steps| mujocos(&mechanism, &walk, &starts, steps)));
    if let Some(file) = &options.mujoco_out {
        let played = played(&mechanism, &walk, &starts);
        std::fs::write(file, played.to_string()).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    }

    if options.json {
        println!("{}", rows.iter().map(Row::json).collect::<Value>());
    } else {
        println!("errors of joints [mrad], place [mm] and angle [mrad] of the trunk after {AFTER:?} ms; µs per period");
        let header = ["engine", "steps", "joints", "", "", "place", "", "", "angle", "", "", "µs"];
        table::print(&header, &rows.iter().map(Row::text).collect::<Vec<_>>());
    }
    true
}

/// Our plant's errors.
fn ours(mechanism: &Mechanism, walk: &Reference, starts: &[usize], steps: u32) -> Row {
    let apart = walk.apart(mechanism, starts, AFTER, |plant| {
        let mut plant = plant.clone();
        plant.set_steps_per_period(steps);
        (plant, Plant::step)
    });
    Row { engine: "ours", steps, apart, cost: None }
}

/// Our plant's time for a control period, walking [s].
fn cost(walk: &Reference, starts: &[usize], steps: u32) -> f64 {
    let mut plants: Vec<Plant> = starts.iter().map(|&start| walk.plants[start].clone()).collect();
    plants.iter_mut().for_each(|plant| plant.set_steps_per_period(steps));
    let began = Instant::now();
    for (plant, &start) in plants.iter_mut().zip(starts) {
        for setpoint in &walk.setpoints[start..start + TIMED] {
            black_box(plant.step(black_box(setpoint)));
        }
    }
    began.elapsed().as_secs_f64() / (TIMED * starts.len()) as f64
}

/// MuJoCo's errors.
fn mujocos(mechanism: &Mechanism, walk: &Reference, starts: &[usize], steps: u32) -> Row {
    let apart = walk.apart(mechanism, starts, AFTER, |plant| {
        let mut outside = Outside::take_over(setup(mechanism, &plant.robot, steps));
        (plant.clone(), move |plant: &mut Plant, setpoint: &Setpoint| outside.step(plant, setpoint))
    });
    Row { engine: "MuJoCo", steps, apart, cost: None }
}

/// MuJoCo's robot in a state.
fn setup(mechanism: &Mechanism, robot: &RobotState, steps: u32) -> Setup {
    let parameters = plant::Parameters { steps_per_period: steps, ..plant_parameters() };
    Setup::new(mechanism, &parameters, &Disturbances::default(), robot, 0, PERIOD).expect("an even floor")
}

/// For each place what an engine is told, and the setpoints that follow: rows of angles, rates and torques.
fn played(mechanism: &Mechanism, walk: &Reference, starts: &[usize]) -> Value {
    let rows = |start: usize| -> Vec<[[f64; 20]; 3]> {
        let setpoints = walk.setpoints[start..start + TIMED].iter();
        setpoints.map(|setpoint| [setpoint.angles.0, setpoint.rates.0, setpoint.feed_forward.0]).collect()
    };
    starts
        .iter()
        .map(|&start| json!({ "told": setup(mechanism, &walk.plants[start].robot, 1), "setpoints": rows(start) }))
        .collect()
}

impl Row {
    fn json(&self) -> Value {
        let Self { engine, steps, apart, cost } = self;
        let of = |value: fn(&Apart) -> f64| apart.iter().map(value).collect::<Vec<f64>>();
        json!({
            "engine": engine,
            "steps_per_period": steps,
            "after_periods": AFTER,
            "joints_rad": of(|apart| apart.joints),
            "trunk_m": of(|apart| apart.place),
            "trunk_rad": of(|apart| apart.turn),
            "period_s": cost,
        })
    }

    fn text(&self) -> Vec<String> {
        let Self { engine, steps, apart, cost } = self;
        let mut text = vec![(*engine).to_owned(), steps.to_string()];
        for value in [|apart: &Apart| apart.joints, |apart: &Apart| apart.place, |apart: &Apart| apart.turn] {
            text.extend(apart.iter().map(|apart| format!("{:.3}", 1e3 * value(apart))));
        }
        text.push(cost.map_or_else(String::new, |cost| format!("{:.2}", 1e6 * cost)));
        text
    }
}
