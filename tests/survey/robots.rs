//! Public robots: each imported from its URDF with nothing but its sole, and walked in our plant and in MuJoCo, which
//! builds its model from the URDF itself. Prints the table of `docs/robots.md`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use halfstep_tests::pushing::{Direction, survives};
use halfstep_tests::walking::Walking;
use interface::{Measurement, Setpoint, Verdict};
use model::{GRAVITY, LegReach};
use plant::Plant;

use crate::cores::on_all_cores;
use crate::imported::{Imported, folders};
use crate::streams::Source;
use crate::watched::Watched;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Folder with a folder for each robot, which holds robot.urdf and sole.toml
    #[arg(long, value_name = "DIR")]
    robots: PathBuf,
    /// Nominal half-steps
    #[arg(long, default_value_t = 60)]
    half_steps: u64,
    /// Random stream over all that can be asked (s)
    #[arg(long, default_value_t = 300.0)]
    stream: f64,
    /// Tiles of 2 mm, scaled by the leg (s)
    #[arg(long, default_value_t = 60.0)]
    tiles: f64,
    /// Not in MuJoCo
    #[arg(long)]
    own_plant_only: bool,
}

/// What became of a robot in one plant.
struct Outcome {
    nominal_falls: bool,
    stream_falls: bool,
    accepted: [u32; 3],
    /// Mean speed of the nominal walk (m/s).
    speed: f64,
}

/// Impulses of the bisection for pushes: shares of mass times √(g·l), and its rounds.
const PUSH_MAX: f64 = 0.4;
const PUSH_ROUNDS: u32 = 6;
/// Places of the half-step where a push begins.
const PUSH_PHASES: [f64; 4] = [0.15, 0.4, 0.65, 0.9];
/// Half-step before the push.
const PUSHED_IN: u64 = 6;

pub(crate) fn survey(options: &Options) -> bool {
    let folders = folders(&options.robots);
    println!(
        "<!-- cargo run --release -p halfstep-survey -- robots --robots DIR --half-steps {} --stream {} --tiles {} -->",
        options.half_steps, options.stream, options.tiles
    );
    println!(
        "| robot | kg, leg m | half-step m, s | largest load | plant | {} half-steps, m/s | stream of {} s: accepted, \
         limited, refused | tiles {} s × 3 | push ahead, aside (m√(gl)) |\n|---|---|---|---|---|---|---|---|---|",
        options.half_steps, options.stream, options.tiles
    );
    let mut passed = true;
    let robots = on_all_cores(folders.len(), |index| examine(options, &folders[index]));
    for (robot, own, other, tiles, pushes) in robots {
        let (load, joint) = robot.robot.half_step.load;
        let parameters = &robot.robot.half_step.parameters;
        let walks = |falls: bool| if falls { "falls" } else { "walks" };
        for (plant, outcome) in [("ours", Some(&own)), ("MuJoCo", other.as_ref())] {
            let Some(outcome) = outcome else { continue };
            let [accepted, limited, refused] = outcome.accepted;
            let is_ours = plant == "ours";
            println!(
                "| {} | {:.1}, {:.2} | {:.3}, {:.2} | {} {:.0} % | {plant} | {}, {:.2} | {}: {accepted}, {limited}, \
                 {refused} | {} | {} |",
                robot.mechanism.name,
                robot.mechanism.mass(),
                LegReach::of(&robot.mechanism).length(),
                parameters.step_length,
                parameters.duration,
                joint.name(),
                load * 100.0,
                walks(outcome.nominal_falls),
                outcome.speed,
                walks(outcome.stream_falls),
                if is_ours { format!("{tiles} falls") } else { "–".to_owned() },
                if is_ours { format!("{:.3}, {:.3}", pushes[0], pushes[1]) } else { "–".to_owned() },
            );
            passed &= !outcome.nominal_falls && !outcome.stream_falls;
        }
    }
    passed
}

fn examine(options: &Options, folder: &Path) -> (Imported, Outcome, Option<Outcome>, u32, [f64; 2]) {
    let robot = Imported::import(folder);
    let own = robot.outcome(options, |_| Plant::step);
    let other = (!options.own_plant_only).then(|| {
        robot.outcome(options, |seed| {
            let mut outside = robot.outside(seed);
            move |plant: &mut Plant, setpoint: &Setpoint| outside.step(plant, setpoint)
        })
    });
    let tiles = (0..3).filter(|seed| robot.falls_on_tiles(options, *seed)).count() as u32;
    let pushes = [Direction::Forward, Direction::ToSwing].map(|direction| robot.push(direction));
    (robot, own, other, tiles, pushes)
}

impl Imported {
    /// Walks nominally, then by a random stream; each in a plant of its own.
    fn outcome<Step>(&self, options: &Options, plant: impl Fn(u64) -> Step) -> Outcome
    where
        Step: FnMut(&mut Plant, &Setpoint) -> Measurement,
    {
        let mut step = plant(1);
        let mut nominal = Watched::begin_in(self.walking(1), &mut step);
        let from = nominal.walking.plant.truth().com;
        while nominal.fall.is_none() && nominal.report.report.half_step.index < options.half_steps {
            nominal.tick_in(None, &mut step);
        }
        let way = (nominal.walking.plant.truth().com - from).xy().norm();

        let mut step = plant(2);
        let mut stream = Watched::begin_in(self.walking(2), &mut step);
        let mut source = Source::new(2);
        let mut accepted = [0; 3];
        while stream.fall.is_none() && stream.walking.time() < options.stream {
            let request = source.next(stream.report.report.half_step.index);
            stream.tick_in(request.as_ref(), &mut step);
            if let Some(reply) = stream.report.reply {
                let verdicts = [Verdict::Accepted, Verdict::Limited, Verdict::Refused];
                for (count, verdict) in accepted.iter_mut().zip(verdicts) {
                    *count += u32::from(reply.verdict == verdict);
                }
            }
        }
        Outcome {
            nominal_falls: nominal.fall.is_some(),
            stream_falls: stream.fall.is_some(),
            accepted,
            speed: way / nominal.walking.time(),
        }
    }

    fn falls_on_tiles(&self, options: &Options, seed: u64) -> bool {
        let mut plant = self.plant.clone();
        plant.unevenness.height = 0.002 * LegReach::of(&self.mechanism).scale();
        let walking = Walking::begin_by(&self.mechanism, Arc::clone(&self.nominal), &self.controller, &plant, seed);
        let mut watched = Watched::new(walking);
        watched.walk_until(options.tiles, None, Plant::step);
        watched.fall.is_some()
    }

    /// The impulse that is survived at every place of the half-step, over mass times √(g·l).
    fn push(&self, direction: Direction) -> f64 {
        let unit = self.mechanism.mass() * (GRAVITY * LegReach::of(&self.mechanism).length()).sqrt();
        let places = PUSH_PHASES.map(|progress| {
            let mut walking = self.walking(3);
            let there = |half_step: interface::HalfStep| half_step.index >= PUSHED_IN && half_step.progress >= progress;
            let reached = walking.walk_until(60.0, |tick| there(tick.report.half_step)).is_ok();
            (reached, walking)
        });
        let (mut survived, mut fell) = (0.0, PUSH_MAX);
        for _ in 0..PUSH_ROUNDS {
            let tried = (survived + fell) / 2.0;
            if places.iter().all(|(reached, walking)| *reached && survives(walking, direction, tried * unit)) {
                survived = tried;
            } else {
                fell = tried;
            }
        }
        survived
    }
}
