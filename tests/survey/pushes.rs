//! Pushes at the trunk: the largest impulse survived, by phase of the half-step and direction. `docs/pushes.md` shows
//! the results.

use std::path::PathBuf;

use config::Config;
use halfstep_tests::pushing::{
    Direction, PUSH_DURATION, WALKS_ON, stand, step_in_place_to, survives, walk_on_by, walk_to,
};
use halfstep_tests::walking::Walking;
use model::{GRAVITY, LegReach, Mechanism};

use crate::cores::on_all_cores;
use crate::{asked, table};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Phases of the half-step
    #[arg(long, default_value_t = 12)]
    phases: usize,
    /// Which half-step, counted from the beginning; the right foot bears in even ones
    #[arg(long, default_value_t = 8)]
    half_step: u64,
    /// Speed factor of the walk
    #[arg(long, default_value_t = 1.0)]
    speed: f64,
    /// Turn of the walk per full step
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    turn_deg: f64,
    /// Step extension of the walk
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    extension_deg: f64,
    /// What the robot does
    #[arg(long, value_enum, default_value_t = Gait::Walk)]
    gait: Gait,
    /// Of the sensors' noise
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Folder of another robot that walks instead, such as config/robots/g1
    #[arg(long, conflicts_with = "gait")]
    robot: Option<PathBuf>,
}

/// What the robot does when it is pushed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Gait {
    Walk,
    InPlace,
    /// At one phase only
    Stand,
}

/// Impulses are tried in these steps, up to the first that fells the robot, and then halved down (N·s): for the paper's
/// robot, and for others in proportion to mass·√(g·l).
const STEP: f64 = 2.0;
const RESOLUTION: f64 = 0.25;
/// Steps up to the hardest push that is tried.
const STEPS_MAX: f64 = 30.0;

/// The directions in their order.
pub(crate) const NAMES: [&str; 9] = [
    "progress",
    "forward",
    "forward, swing",
    "swing",
    "back, swing",
    "back",
    "back, support",
    "support",
    "forward, support",
];

pub(crate) fn survey(options: &Options) -> bool {
    let phases = if options.gait == Gait::Stand { 1 } else { options.phases };
    let directions = Direction::ALL;
    let own = impulse_unit(&halfstep_tests::mechanism());
    let unit = options.robot.as_ref().map_or(own, |folder| {
        let mechanism = Mechanism::load(folder.join("mechanism.toml")).unwrap_or_else(|error| panic!("{error}"));
        impulse_unit(&mechanism)
    });
    let scale = unit / own;
    let survived = on_all_cores(phases * directions.len(), |index| {
        let phase = (index / directions.len()) as f64 / phases as f64;
        let direction = directions[index % directions.len()];
        pushed_at(options, phase).map_or(0.0, |walking| {
            largest_survived(STEP * scale, RESOLUTION * scale, |impulse| survives(&walking, direction, impulse))
        })
    });
    println!("N·s over {PUSH_DURATION} s at the trunk, survived if it goes on {WALKS_ON} s later:");
    let passed = print(&survived, &directions.map(|direction| direction.demanded() * scale));
    println!("thousandths of mass·√(g·l), which is {unit:.1} N·s:");
    let shares: Vec<f64> = survived.iter().map(|impulse| 1e3 * impulse / unit).collect();
    print(&shares, &directions.map(|direction| 1e3 * direction.demanded() / own));
    passed
}

/// Mass·√(g·l) with the length of the legs (N·s).
fn impulse_unit(mechanism: &Mechanism) -> f64 {
    mechanism.mass() * (GRAVITY * LegReach::of(mechanism).length()).sqrt()
}

/// The robot when it is pushed.
fn pushed_at(options: &Options, phase: f64) -> Option<Walking> {
    let request = asked::request(options.speed, options.turn_deg, options.extension_deg);
    match options.gait {
        Gait::Walk => match &options.robot {
            Some(folder) => walk_on_by(Walking::of_robot(folder, options.seed), request, options.half_step, phase),
            None => walk_to(options.seed, request, options.half_step, phase),
        },
        Gait::InPlace => step_in_place_to(options.seed, options.half_step, phase),
        Gait::Stand => Some(stand(options.seed)),
    }
}

/// Prints what is survived, phase by phase in all directions. Returns whether that is what is demanded.
pub(crate) fn print(survived: &[f64], demanded: &[f64]) -> bool {
    let directions = demanded.len();
    let phases = survived.len() / directions;
    let row = |name: String, impulses: &[f64]| -> Vec<String> {
        std::iter::once(name).chain(impulses.iter().map(|impulse| format!("{impulse:.2}"))).collect()
    };
    let sorted: Vec<Vec<f64>> = (0..directions)
        .map(|direction| {
            let mut all: Vec<f64> = survived.iter().skip(direction).step_by(directions).copied().collect();
            all.sort_by(f64::total_cmp);
            all
        })
        .collect();
    let [least, median] = [0, phases / 2].map(|rank| sorted.iter().map(|all| all[rank]).collect::<Vec<f64>>());
    let mut rows: Vec<Vec<String>> = survived
        .chunks(directions)
        .enumerate()
        .map(|(phase, survived)| row(format!("{:.3}", phase as f64 / phases as f64), survived))
        .collect();
    rows.extend([row("least".into(), &least), row("median".into(), &median), row("demanded".into(), demanded)]);
    table::print(&NAMES, &rows);
    std::iter::zip(&least, demanded).all(|(least, demanded)| least >= demanded)
}

/// The largest impulse below all that fell it. Where a robot falls is not monotonic: so all from none upwards are
/// tried.
///
/// * `step` – the distance of the impulses that are tried; halved down to `resolution` after the first fall (N·s)
pub(crate) fn largest_survived(step: f64, resolution: f64, survives: impl Fn(f64) -> bool) -> f64 {
    let (mut survived, most) = (0.0, STEPS_MAX * step);
    while survived < most && survives(survived + step) {
        survived += step;
    }
    let mut finer = step / 2.0;
    while finer >= resolution && survived < most {
        if survives(survived + finer) {
            survived += finer;
        }
        finer /= 2.0;
    }
    survived
}
