//! Start and stop: random sequences of start, walk, turn, speed up, slow down, stop, hold, start again.

use halfstep_tests::random;
use halfstep_tests::sequence::{self, TO_STAND_MAX, TO_WALK_MAX, Tally, Trouble};
use halfstep_tests::walking::{Walking, controller_parameters};

use crate::cores::on_all_cores;
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How many sequences
    #[arg(long, default_value_t = 1000)]
    seeds: u64,
    /// The first one's seed
    #[arg(long, default_value_t = 0)]
    first_seed: u64,
    /// What is done in each
    #[arg(long, default_value_t = 15)]
    acts: u32,
}

pub(crate) fn survey(options: &Options) -> bool {
    let limits = controller_parameters().gait.limits;
    let sequences = on_all_cores(options.seeds as usize, |index| {
        let seed = options.first_seed + index as u64;
        sequence::play(&mut Walking::begin(seed), &mut random(seed), &limits, options.acts)
    });

    for (index, trouble) in sequences.iter().enumerate() {
        if let Err(Trouble { fell, time, what }) = trouble {
            let kind = if *fell { "fell" } else { "stuck" };
            println!("seed {}: {kind} at {time:.2} s, {what}", options.first_seed + index as u64);
        }
    }
    let troubles = || sequences.iter().filter_map(|sequence| sequence.as_ref().err());
    let (falls, stuck) = (troubles().filter(|it| it.fell).count(), troubles().filter(|it| !it.fell).count());
    let done: Vec<Tally> = sequences.iter().filter_map(|sequence| sequence.as_ref().ok().copied()).collect();
    let sum = |count: fn(&Tally) -> f64| done.iter().map(count).sum::<f64>();
    let most = |value: fn(&Tally) -> f64| done.iter().map(value).fold(0.0, f64::max);
    let rows = [
        ("sequences", options.seeds.to_string()),
        ("falls", falls.to_string()),
        ("stuck modes", stuck.to_string()),
        ("stops", sum(|tally| f64::from(tally.stops)).to_string()),
        ("slowest to a stand s", format!("{:.2} of {TO_STAND_MAX} granted", most(|tally| tally.slowest_stop))),
        ("starts", sum(|tally| f64::from(tally.starts)).to_string()),
        (
            "slowest to a half-step s",
            format!("{:.2} of {} granted", most(|tally| tally.slowest_start), TO_STAND_MAX + TO_WALK_MAX),
        ),
        ("changes", sum(|tally| f64::from(tally.changes)).to_string()),
        ("minutes", format!("{:.0}", sum(|tally| tally.seconds) / 60.0)),
    ];
    table::print(&["what", "of those without trouble"], &rows.map(|(what, value)| vec![what.to_owned(), value]));
    falls + stuck == 0
}
