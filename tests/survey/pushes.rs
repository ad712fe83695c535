//! Pushes at the trunk: the largest impulse survived, by phase of the half-step and direction.

use halfstep_tests::pushing::{Direction, PUSH_DURATION, WALKS_ON, survives, walk_to};
use interface::GaitChange;

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
    /// Of the sensors' noise
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

/// Impulses are tried in these steps, up to the first that fells the robot, and then halved down (N·s).
const STEP: f64 = 2.0;
const RESOLUTION: f64 = 0.25;
/// Nobody is pushed harder (N·s).
const IMPULSE_MAX: f64 = 60.0;

pub(crate) fn survey(options: &Options) -> bool {
    let request = asked::request(options.speed, options.turn_deg, options.extension_deg);
    let directions = Direction::ALL;
    let survived = on_all_cores(options.phases * directions.len(), |index| {
        let phase = (index / directions.len()) as f64 / options.phases as f64;
        largest_survived(options, request, phase, directions[index % directions.len()])
    });

    let mut rows: Vec<Vec<String>> = Vec::new();
    for (phase, survived) in survived.chunks(directions.len()).enumerate() {
        let place = format!("{:.3}", phase as f64 / options.phases as f64);
        rows.push(std::iter::once(place).chain(survived.iter().map(|impulse| format!("{impulse:.2}"))).collect());
    }
    let least: Vec<f64> = (0..directions.len())
        .map(|direction| {
            survived.iter().skip(direction).step_by(directions.len()).copied().fold(f64::INFINITY, f64::min)
        })
        .collect();
    let medians = (0..directions.len()).map(|direction| {
        let mut all: Vec<f64> = survived.iter().skip(direction).step_by(directions.len()).copied().collect();
        all.sort_by(f64::total_cmp);
        format!("{:.2}", all[all.len() / 2])
    });
    rows.push(std::iter::once("least".into()).chain(least.iter().map(|impulse| format!("{impulse:.2}"))).collect());
    rows.push(std::iter::once("median".into()).chain(medians).collect());
    let demanded = directions.map(Direction::demanded);
    rows.push(std::iter::once("demanded".into()).chain(demanded.map(|impulse| format!("{impulse:.2}"))).collect());
    println!("N·s over {PUSH_DURATION} s at the trunk, survived if it walks {WALKS_ON} s later:");
    table::print(
        &[
            "progress",
            "forward",
            "forward, swing",
            "swing side",
            "back, swing",
            "back",
            "back, support",
            "support side",
            "forward, support",
        ],
        &rows,
    );
    std::iter::zip(least, demanded).all(|(least, demanded)| least >= demanded)
}

/// The largest impulse below all that fell it. Where a robot falls is not monotonic: so all from none upwards are
/// tried.
fn largest_survived(options: &Options, request: GaitChange, phase: f64, direction: Direction) -> f64 {
    let Some(walking) = walk_to(options.seed, request, options.half_step, phase) else { return 0.0 };
    let mut survived = 0.0;
    while survived < IMPULSE_MAX && survives(&walking, direction, survived + STEP) {
        survived += STEP;
    }
    let mut step = STEP / 2.0;
    while step >= RESOLUTION && survived < IMPULSE_MAX {
        if survives(&walking, direction, survived + step) {
            survived += step;
        }
        step /= 2.0;
    }
    survived
}
