//! Pushes at the trunk: the largest impulse survived, by phase of the half-step and direction. `docs/pushes.md` shows
//! the results.

use halfstep_tests::pushing::{Direction, PUSH_DURATION, WALKS_ON, stand, step_in_place_to, survives, walk_to};
use halfstep_tests::walking::Walking;

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
}

/// What the robot does when it is pushed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Gait {
    Walk,
    InPlace,
    /// At one phase only
    Stand,
}

/// Impulses are tried in these steps, up to the first that fells the robot, and then halved down (N·s).
const STEP: f64 = 2.0;
const RESOLUTION: f64 = 0.25;
/// Nobody is pushed harder (N·s).
const IMPULSE_MAX: f64 = 60.0;

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
    let survived = on_all_cores(phases * directions.len(), |index| {
        let phase = (index / directions.len()) as f64 / phases as f64;
        let direction = directions[index % directions.len()];
        pushed_at(options, phase)
            .map_or(0.0, |walking| largest_survived(STEP, RESOLUTION, |impulse| survives(&walking, direction, impulse)))
    });
    println!("N·s over {PUSH_DURATION} s at the trunk, survived if it goes on {WALKS_ON} s later:");
    print(&survived, &directions.map(Direction::demanded))
}

/// The robot when it is pushed.
fn pushed_at(options: &Options, phase: f64) -> Option<Walking> {
    let request = asked::request(options.speed, options.turn_deg, options.extension_deg);
    match options.gait {
        Gait::Walk => walk_to(options.seed, request, options.half_step, phase),
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
    let mut survived = 0.0;
    while survived < IMPULSE_MAX && survives(survived + step) {
        survived += step;
    }
    let mut finer = step / 2.0;
    while finer >= resolution && survived < IMPULSE_MAX {
        if survives(survived + finer) {
            survived += finer;
        }
        finer /= 2.0;
    }
    survived
}
