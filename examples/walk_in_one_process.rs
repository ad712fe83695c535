//! Controller and simulated robot in one process, period by period, without shared memory: ten seconds of walking with
//! a turn on the way.
//!
//! ```text
//! cargo run --release --example walk_in_one_process
//! ```

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use config::Config;
use controller::{Controller, Driver, InlineWorker};
use gait::{NominalTable, Start, Walk};
use interface::{GaitChange, Request, Source};
use model::Mechanism;
use plant::Plant;

/// Control period (s).
const PERIOD: f64 = 1e-3;

fn main() -> Result<(), Box<dyn Error>> {
    // The robot, its nominal half-step, and the parameters of both sides.
    let mechanism = Mechanism::load("config/mechanism.toml")?;
    let nominal = Arc::new(NominalTable::read_csv(Path::new("config/nominal_half_step.csv"))?);
    let parameters = controller::Parameters::load("config/controller.toml")?;
    let plant_parameters = plant::PlantParameters::load("config/plant.toml")?;

    // Both begin at the start of the nominal half-step.
    let start = Start::default();
    let controller = Controller::new(&mechanism, Arc::clone(&nominal), &parameters, start)?;
    let mut driver = Driver { controller, worker: InlineWorker };
    let motion = Walk::new(nominal, &mechanism, &parameters.gait, start)?.physical_motion();
    let mut plant = Plant::new(&mechanism, &plant_parameters, &motion, PERIOD, 1);

    let turn = GaitChange { turn: Some(15_f64.to_radians()), ..GaitChange::NONE };
    let turn = Request { gait: turn, ..Request::new(Source::Program) };
    let mut measurement = plant.measure();
    for period in 0..10_000 {
        let step = driver.step(PERIOD, Some(&measurement), |_| (period == 3000).then_some(turn));
        if let Some(reply) = step.tick.reply {
            println!("{:.1} s: {} from half-step {}", plant.time(), reply.verdict, reply.effect_half_step);
        }
        measurement = plant.step(&step.tick.setpoint);
    }

    let truth = plant.truth();
    println!(
        "{} after {:.1} s, at x {:.2} m, y {:.2} m",
        driver.controller.mode(),
        plant.time(),
        truth.com.x,
        truth.com.y
    );
    if truth.has_fallen() { Err("the robot has fallen".into()) } else { Ok(()) }
}

#[test]
fn the_example_walks() {
    std::env::set_current_dir(halfstep_examples::repository()).expect("the repository is there");
    main().expect("it walks");
}
