//! The grid: speed, turn and extension in every combination.

use interface::Verdict;

use crate::asked::{self, EXTENSIONS_DEG, SPEEDS, TURNS_DEG, spread};
use crate::cores::on_all_cores;
use crate::single::walk;
use crate::table::{self, millimetres};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Values of speed, of turn and of extension
    #[arg(long, num_args = 3, value_names = ["SPEEDS", "TURNS", "EXTENSIONS"], default_values_t = [7, 7, 5],
          value_parser = clap::value_parser!(u16).range(2..))]
    knots: Vec<u16>,
    /// Half-steps to walk by each
    #[arg(long, default_value_t = 60)]
    half_steps: u64,
    /// Of the sensors' noise
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

/// Share that must be accepted or limited.
const GRANTED_SHARE: f64 = 0.8;

pub(crate) fn survey(options: &Options) -> bool {
    let [speeds, turns, extensions] = [0, 1, 2].map(|axis: usize| usize::from(options.knots[axis]));
    let mut all = Vec::new();
    for speed in spread(&SPEEDS, speeds) {
        for turn in spread(&TURNS_DEG, turns) {
            all.extend(spread(&EXTENSIONS_DEG, extensions).map(|extension| asked::request(speed, turn, extension)));
        }
    }
    let walks = on_all_cores(all.len(), |index| walk(all[index], options.half_steps, options.seed));

    let verdicts = [Verdict::Accepted, Verdict::Limited, Verdict::Refused];
    let rows = verdicts.map(|verdict| {
        let of_it: Vec<_> = walks.iter().filter(|(given, _)| *given == verdict).map(|(_, watched)| watched).collect();
        let falls = of_it.iter().filter(|watched| watched.fall.is_some()).count();
        let least = of_it.iter().map(|watched| watched.least_margin).fold(f64::INFINITY, f64::min);
        let largest = of_it.iter().map(|watched| watched.largest_lean).fold(0.0, f64::max);
        let margin = if of_it.is_empty() { "–".into() } else { millimetres(least) };
        vec![
            format!("{verdict:?}"),
            of_it.len().to_string(),
            falls.to_string(),
            margin,
            format!("{:.2}", largest.to_degrees()),
        ]
    });
    table::print(&["verdict", "combinations", "falls", "least margin mm", "largest feedback °"], &rows);
    let falls: Vec<_> = walks.iter().filter_map(|(_, watched)| watched.fall.as_ref()).collect();
    for fall in &falls {
        println!("{fall}");
    }
    let refused = walks.iter().filter(|(verdict, _)| *verdict == Verdict::Refused).count();
    let granted = 1.0 - refused as f64 / walks.len() as f64;
    println!("{:.0} % accepted or limited, {} falls of {} walks", granted * 100.0, falls.len(), walks.len());
    falls.is_empty() && granted >= GRANTED_SHARE
}
