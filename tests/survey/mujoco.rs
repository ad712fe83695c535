//! MuJoCo: what is granted in our own plant, walked in a physics engine that none of us wrote, with the same
//! parameters.

use std::cell::RefCell;

use controller::Parameters;
use gait::{Start, Walk};
use halfstep_tests::fall_trial::{AfterReset, FallTrial};
use halfstep_tests::mechanism;
use halfstep_tests::walking::{PERIOD, Walking, controller_parameters, nominal, plant_parameters};
use interface::{GaitChange, Measurement, Setpoint, Verdict};
use model::{Mechanism, Motion};
use node::engine::{self, EngineSetup, ExternalEngine};
use plant::{Disturbances, Plant, RobotState};

use crate::asked::request;
use crate::cores::on_all_cores;
use crate::streams::Source;
use crate::table::{self, millimetres};
use crate::watched::Watched;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How long each single command is walked (s)
    #[arg(long, default_value_t = 40.0)]
    seconds: f64,
    /// How many random streams besides
    #[arg(long, default_value_t = 10)]
    streams: u64,
    /// How long each (s)
    #[arg(long, default_value_t = 300.0)]
    stream_seconds: f64,
}

/// `c`, `α` (deg), `β` (deg): what must walk (issue "The world outside").
const COMMANDS: [(f64, f64, f64); 15] = [
    (1.0, 0.0, 0.0),
    (0.6, 0.0, 0.0),
    (0.7, 0.0, 0.0),
    (0.8, 0.0, 0.0),
    (0.9, 0.0, 0.0),
    (1.1, 0.0, 0.0),
    (1.2, 0.0, 0.0),
    (1.3, 0.0, 0.0),
    (1.4, 0.0, 0.0),
    (1.0, 25.0, 0.0),
    (1.0, -25.0, 0.0),
    (1.0, 0.0, -5.0),
    (1.0, 0.0, 10.0),
    (1.2, 15.0, 5.0),
    (0.8, -20.0, 5.0),
];

/// Another engine in place of the plant's own physics.
pub(crate) struct Outside {
    engine: ExternalEngine,
}

impl Outside {
    /// MuJoCo with the robot of a plant that begins with `start`, in physical joints, and with its pushes.
    pub(crate) fn begin(
        mechanism: &Mechanism,
        parameters: &plant::PlantParameters,
        disturbances: &Disturbances,
        start: &Motion,
        seed: u64,
    ) -> Self {
        let robot = RobotState::on_right_foot(start, 0.0);
        Self::take_over(
            EngineSetup::new(mechanism, parameters, disturbances, &robot, seed, PERIOD)
                .expect("tiles that are not too small"),
        )
    }

    /// MuJoCo with the robot that it is told.
    pub(crate) fn take_over(setup: EngineSetup) -> Self {
        let python = engine::mujoco().unwrap_or_else(|failure| panic!("{failure}"));
        Self { engine: ExternalEngine::start(python, &setup).unwrap_or_else(|error| panic!("{error}")) }
    }

    /// Moves the plant's robot on by one control period.
    pub(crate) fn step(&mut self, plant: &mut Plant, setpoint: &Setpoint) -> Measurement {
        self.engine.step(plant, setpoint).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// A walk that can be moved by MuJoCo, too: where it begins.
pub(crate) fn start(mechanism: &Mechanism, controller: &Parameters) -> Motion {
    Walk::new(nominal(), mechanism, &controller.gait, Start::default())
        .expect("the committed nominal walks")
        .physical_motion()
}

/// A fall and a reset.
pub(crate) fn after_fall(trial: &FallTrial) -> AfterReset {
    let (mechanism, controller, plant) = (mechanism(), controller_parameters(), plant_parameters());
    let begins = start(&mechanism, &controller);
    let mut walking = Walking::begin_with(&mechanism, &controller, &plant, trial.seed);
    walking.plant.disturbances.pushes.push(trial.push());
    let outside = Outside::begin(&mechanism, &plant, &walking.plant.disturbances, &begins, trial.seed);
    let outside = RefCell::new(outside);
    let step = |robot: &mut Plant, setpoint: &Setpoint| outside.borrow_mut().step(robot, setpoint);
    let place = |_: &Plant, posture: &Motion| {
        let nothing = Disturbances::default();
        outside.replace(Outside::begin(&mechanism, &plant, &nothing, posture, trial.seed));
    };
    trial.run_in(walking, step, place)
}

pub(crate) fn survey(options: &Options) -> bool {
    let singles = COMMANDS.len();
    let walks = on_all_cores(singles + options.streams as usize, |index| match COMMANDS.get(index) {
        Some(&(speed, turn, extension)) => {
            let wanted = request(speed, turn, extension);
            walk(index as u64, options.seconds, |half_step| (half_step == 4).then_some(wanted))
        }
        None => {
            let seed = (index - singles) as u64;
            let mut source = Source::new(seed);
            walk(seed, options.stream_seconds, |half_step| source.next(half_step))
        }
    });
    let rows: Vec<Vec<String>> = walks
        .iter()
        .enumerate()
        .map(|(index, (watched, refused))| {
            let name = match COMMANDS.get(index) {
                Some((speed, turn, extension)) => format!("c {speed:.1} α {turn:.0}° β {extension:.0}°"),
                None => format!("stream {}, {} s", index - singles, options.stream_seconds),
            };
            vec![
                name,
                watched.report.report.half_step.index.to_string(),
                refused.to_string(),
                millimetres(watched.least_margin),
                watched.fall.as_ref().map_or_else(|| "walks".into(), ToString::to_string),
            ]
        })
        .collect();
    table::print(&["in MuJoCo", "half-steps", "refused", "least margin mm", "outcome"], &rows);
    let falls = walks.iter().filter(|(watched, _)| watched.fall.is_some()).count();
    println!("{falls} falls of {} walks", walks.len());
    falls == 0
}

/// Walks by what is asked in each half-step; how often was that refused?
fn walk(seed: u64, seconds: f64, mut asked: impl FnMut(u64) -> Option<GaitChange>) -> (Watched, u32) {
    let (mechanism, controller, plant) = (mechanism(), controller_parameters(), plant_parameters());
    let start = start(&mechanism, &controller);
    let mut outside = Outside::begin(&mechanism, &plant, &Disturbances::default(), &start, seed);
    let walking = Walking::begin_with(&mechanism, &controller, &plant, seed);
    let mut watched = Watched::begin_in(walking, |plant, setpoint| outside.step(plant, setpoint));
    let (mut refused, mut last) = (0, u64::MAX);
    while watched.fall.is_none() && watched.walking.time() < seconds {
        let half_step = watched.report.report.half_step.index;
        let request = if half_step == last { None } else { asked(half_step) };
        last = half_step;
        watched.tick_in(request.as_ref(), |plant, setpoint| outside.step(plant, setpoint));
        refused += watched.report.reply.map_or(0, |answer| u32::from(answer.verdict == Verdict::Refused));
    }
    (watched, refused)
}
