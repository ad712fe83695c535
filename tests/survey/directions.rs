//! The fastest walk of each direction, kept up: the built-in robot at the speeds that are asked of it, public robots at
//! the same speeds in their proportions (speeds by √(g·leg), turns by √(g/leg)), in our plant and in MuJoCo.

use std::path::{Path, PathBuf};

use halfstep_tests::mechanism;
use halfstep_tests::velocity::{MeanVelocity, true_pose};
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{Measurement, Request, Setpoint, Source, Verdict, WalkVelocity};
use model::LegReach;
use plant::{Disturbances, Plant};

use crate::cores::on_all_cores;
use crate::imported::{Imported, folders};
use crate::mujoco::{self, Outside};
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Folder with a folder for each robot, which holds robot.urdf and sole.toml; without it the built-in robot walks
    #[arg(long, value_name = "DIR")]
    robots: Option<PathBuf>,
    /// In MuJoCo instead of our plant
    #[arg(long)]
    mujoco: bool,
    /// How long each direction is kept up (s)
    #[arg(long, default_value_t = 30.0)]
    seconds: f64,
    /// The first seed
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

/// A direction, and the speeds that are asked in it: those of the built-in robot, which the others have in proportion.
const DIRECTIONS: [(&str, WalkVelocity); 6] = [
    ("ahead 1.1 m/s", WalkVelocity { ahead: 1.1, left: 0.0, turn: 0.0 }),
    ("back 0.45 m/s", WalkVelocity { ahead: -0.45, left: 0.0, turn: 0.0 }),
    ("left 0.25 m/s", WalkVelocity { ahead: 0.0, left: 0.25, turn: 0.0 }),
    ("right 0.25 m/s", WalkVelocity { ahead: 0.0, left: -0.25, turn: 0.0 }),
    ("left 60°/s", WalkVelocity { ahead: 0.0, left: 0.0, turn: 60.0 * DEGREE }),
    ("right 60°/s", WalkVelocity { ahead: 0.0, left: 0.0, turn: -60.0 * DEGREE }),
];
const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// How much more than that is asked: what is walked must not be less.
const MORE: f64 = 1.02;
/// Shares that must be walked: by the built-in robot and by the others.
const LEAST: [f64; 2] = [1.0, 0.75];
/// What is not granted whole is asked again after so long (s), as by an operator who holds the stick.
const ASKED_EVERY: f64 = 1.5;
/// From when on the velocity is measured (s).
const MEASURED_FROM: f64 = 14.0;

/// What became of a walk.
struct Outcome {
    granted: WalkVelocity,
    walked: WalkVelocity,
    falls: bool,
}

pub(crate) fn survey(options: &Options) -> bool {
    let robots: Vec<Option<PathBuf>> = match &options.robots {
        Some(robots) => folders(robots).into_iter().map(Some).collect(),
        None => vec![None],
    };
    let walks = on_all_cores(robots.len() * DIRECTIONS.len(), |index| {
        let (robot, (_, velocity)) = (&robots[index / DIRECTIONS.len()], DIRECTIONS[index % DIRECTIONS.len()]);
        match robot {
            Some(folder) => walk_imported(options, folder, &velocity),
            None => walk_built_in(options, &velocity),
        }
    });
    let mut passed = true;
    let rows: Vec<Vec<String>> = robots
        .iter()
        .zip(walks.chunks(DIRECTIONS.len()))
        .map(|(robot, walks)| {
            let least = LEAST[usize::from(robot.is_some())];
            let name = robot.as_ref().and_then(|folder| folder.file_name());
            let mut row = vec![name.map_or_else(|| "built in".into(), |name| name.to_string_lossy().into_owned())];
            row.extend(walks.iter().map(|(asked, outcome)| {
                let [granted, walked] = [&outcome.granted, &outcome.walked].map(|velocity| share(asked, velocity));
                passed &= !outcome.falls && walked >= least;
                let falls = if outcome.falls { " falls" } else { "" };
                format!("{:.0} of {:.0} %{falls}", 100.0 * walked, 100.0 * granted)
            }));
            row
        })
        .collect();
    let mut header = vec!["walked of granted"];
    header.extend(DIRECTIONS.iter().map(|(name, _)| *name));
    table::print(&header, &rows);
    passed
}

fn walk_built_in(options: &Options, velocity: &WalkVelocity) -> (WalkVelocity, Outcome) {
    let (mechanism, controller, plant) = (mechanism(), controller_parameters(), plant_parameters());
    let walking = Walking::begin_with(&mechanism, &controller, &plant, options.seed);
    let mut outside = options.mujoco.then(|| {
        let start = mujoco::start(&mechanism, &controller);
        Outside::begin(&mechanism, &plant, &Disturbances::default(), &start, options.seed)
    });
    (*velocity, walk(options, walking, outside.as_mut(), velocity))
}

fn walk_imported(options: &Options, folder: &Path, velocity: &WalkVelocity) -> (WalkVelocity, Outcome) {
    let robot = Imported::import(folder);
    let scale = LegReach::of(&robot.mechanism).scale().sqrt();
    let WalkVelocity { ahead, left, turn } = *velocity;
    let velocity = WalkVelocity { ahead: ahead * scale, left: left * scale, turn: turn / scale };
    let mut outside = options.mujoco.then(|| robot.outside(options.seed));
    (velocity, walk(options, robot.walking(options.seed), outside.as_mut(), &velocity))
}

fn walk(options: &Options, mut walking: Walking, mut outside: Option<&mut Outside>, asked: &WalkVelocity) -> Outcome {
    let mut step = |plant: &mut Plant, setpoint: &Setpoint| -> Measurement {
        match &mut outside {
            Some(outside) => outside.step(plant, setpoint),
            None => plant.step(setpoint),
        }
    };
    let (mut granted, mut next, mut mean) = (WalkVelocity::default(), 2.0, None::<MeanVelocity>);
    while walking.time() < MEASURED_FROM + options.seconds {
        let asks = walking.time() >= next;
        let velocity = Some(asked.scaled(MORE));
        let request = asks.then(|| Request { velocity, ..Request::new(Source::Console) });
        next = if asks { f64::INFINITY } else { next };
        let tick = walking.tick_in(request.as_ref(), &mut step);
        if let Some(reply) = tick.reply {
            let is_whole = reply.verdict == Verdict::Accepted || walking.time() > MEASURED_FROM - ASKED_EVERY;
            next = if is_whole { f64::INFINITY } else { walking.time() + ASKED_EVERY };
            if reply.verdict != Verdict::Refused {
                granted = reply.walk.velocity;
            }
        }
        if walking.has_fallen(&tick) {
            return Outcome { granted, walked: WalkVelocity::default(), falls: true };
        }
        if walking.time() >= MEASURED_FROM {
            let pose = true_pose(&walking);
            mean.get_or_insert_with(|| MeanVelocity::since(walking.time(), pose)).add(walking.time(), pose);
        }
    }
    Outcome { granted, walked: mean.map_or_else(WalkVelocity::default, |mean| mean.value()), falls: false }
}

/// How much of what was asked a velocity is, in the direction that was asked (-).
fn share(asked: &WalkVelocity, velocity: &WalkVelocity) -> f64 {
    let product = |one: &WalkVelocity, other: &WalkVelocity| {
        one.ahead * other.ahead + one.left * other.left + one.turn * other.turn
    };
    product(asked, velocity) / product(asked, asked)
}
