//! Single commands: speed, turn and extension, each alone over more than is granted, entered from the nominal walk.

use halfstep_tests::walking::Walking;
use interface::{GaitChange, Verdict};

use crate::asked::{self, EXTENSIONS_DEG, SPEEDS, TURNS_DEG, spread};
use crate::cores::on_all_cores;
use crate::table::{self, millimetres};
use crate::watched::Watched;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Values of each quantity
    #[arg(long, default_value_t = 11, value_parser = clap::value_parser!(u16).range(2..))]
    values: u16,
    /// Half-steps to walk by each
    #[arg(long, default_value_t = 60)]
    half_steps: u64,
    /// Of the sensors' noise
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

/// Half-steps of the nominal walk before the request.
pub(crate) const ENTRY: u64 = 4;
/// What must be granted as asked (issue "It walks what it accepts"): `c`, `|α|` (deg) and `β` (deg).
const SPEEDS_DEMANDED: std::ops::RangeInclusive<f64> = 0.6..=1.4;
const TURN_DEMANDED_DEG: f64 = 25.0;
const EXTENSIONS_DEMANDED_DEG: std::ops::RangeInclusive<f64> = -5.0..=10.0;
/// Values that are spread by sums miss by a rounding error.
const ROUNDING: f64 = 1e-9;

pub(crate) fn survey(options: &Options) -> bool {
    let values = usize::from(options.values);
    let speeds = spread(&SPEEDS, values).map(|speed| (speed, 0.0, 0.0));
    let turns = spread(&TURNS_DEG, values).map(|turn| (1.0, turn, 0.0));
    let extensions = spread(&EXTENSIONS_DEG, values).map(|extension| (1.0, 0.0, extension));
    let all: Vec<_> = speeds.chain(turns).chain(extensions).collect();

    let walks = on_all_cores(all.len(), |index| {
        let (speed, turn, extension) = all[index];
        walk(asked::request(speed, turn, extension), options.half_steps, options.seed)
    });

    let mut passed = true;
    let rows: Vec<Vec<String>> = std::iter::zip(&all, &walks)
        .map(|(&(speed, turn, extension), (verdict, watched))| {
            let demanded = speed > SPEEDS_DEMANDED.start() - ROUNDING
                && speed < SPEEDS_DEMANDED.end() + ROUNDING
                && turn.abs() < TURN_DEMANDED_DEG + ROUNDING
                && extension > EXTENSIONS_DEMANDED_DEG.start() - ROUNDING
                && extension < EXTENSIONS_DEMANDED_DEG.end() + ROUNDING;
            let missed = demanded && *verdict != Verdict::Accepted;
            passed &= watched.fall.is_none() && !missed;
            vec![
                format!("c {speed:.2} α {turn:.1}° β {extension:.1}°"),
                format!("{verdict:?}"),
                asked::text(&watched.report.command),
                millimetres(watched.least_margin),
                format!("{:.2}", watched.largest_lean.to_degrees()),
                watched.fall.as_ref().map_or_else(|| "walks".into(), ToString::to_string)
                    + if missed { ", and should be accepted" } else { "" },
            ]
        })
        .collect();
    table::print(&["asked", "verdict", "in force", "least margin mm", "feedback °", "outcome"], &rows);
    passed
}

/// Walks by `request` for so many half-steps, after a few of the nominal walk.
pub(crate) fn walk(request: GaitChange, half_steps: u64, seed: u64) -> (Verdict, Watched) {
    let mut watched = Watched::new(Walking::begin(seed));
    watched.walk_half_steps(ENTRY);
    watched.begin_anew();
    watched.tick(Some(&request));
    let verdict = watched.report.reply.map_or(Verdict::Refused, |answer| answer.verdict);
    watched.walk_half_steps(half_steps);
    (verdict, watched)
}
