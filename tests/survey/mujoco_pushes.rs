//! Pushes at the trunk in MuJoCo: the same protocol and the same parameters as in our own plant.

use halfstep_tests::mechanism;
use halfstep_tests::pushing::{Direction, PUSH_DURATION, WALKS_ON};
use halfstep_tests::walking::{Walking, controller_parameters, nominal, plant_parameters};
use interface::Mode;
use model::Mechanism;
use nalgebra::Vector3;
use plant::{Disturbances, Push};

use crate::cores::on_all_cores;
use crate::mujoco::{Outside, start};
use crate::pushes::{self, largest_survived};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Phases of the half-step
    #[arg(long, default_value_t = 6)]
    phases: usize,
    /// Impulses are tried in these steps, halved once after the first fall (N·s)
    #[arg(long, default_value_t = 4.0)]
    step: f64,
    /// Of the sensors' noise
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

/// The half-step in which the robot is pushed; the right foot bears in it.
const HALF_STEP: f64 = 8.0;

pub(crate) fn survey(options: &Options) -> bool {
    let directions = Direction::ALL;
    let survived = on_all_cores(options.phases * directions.len(), |index| {
        let phase = (index / directions.len()) as f64 / options.phases as f64;
        let direction = directions[index % directions.len()];
        largest_survived(options.step, options.step / 2.0, |impulse| survives(options.seed, phase, direction, impulse))
    });
    println!("N·s over {PUSH_DURATION} s at the trunk in MuJoCo, survived if it walks {WALKS_ON} s later:");
    pushes::print(&survived, &directions.map(Direction::demanded))
}

/// Whether the nominal walk goes on after a push.
fn survives(seed: u64, phase: f64, direction: Direction, impulse: f64) -> bool {
    let (mechanism, controller, plant) = (mechanism(), controller_parameters(), plant_parameters());
    // It walks straight ahead along x, half-step after half-step.
    let pushed_at = (HALF_STEP + phase) * nominal().duration;
    let along = direction.ahead_and_to_swing();
    let push = Push {
        link: Mechanism::TRUNK,
        impulse: Vector3::new(along.x, along.y, 0.0) * impulse,
        start: pushed_at,
        duration: PUSH_DURATION,
    };
    let disturbances = Disturbances { pushes: vec![push], sensor_faults: Vec::new() };
    let mut outside = Outside::begin(&mechanism, &plant, &disturbances, &start(&mechanism, &controller), seed);
    let mut walking = Walking::begin_with(&mechanism, &controller, &plant, seed);
    let end = pushed_at + WALKS_ON;
    let mut mode = Mode::Walking;
    while walking.time() < end && !matches!(mode, Mode::Fallen | Mode::Faulted) {
        mode = walking.tick_in(None, |plant, setpoint| outside.step(plant, setpoint)).report.mode;
    }
    mode == Mode::Walking && !walking.plant.truth().has_fallen()
}
