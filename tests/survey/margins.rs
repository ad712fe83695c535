//! Margins: the least margin of each half-step as the plan predicts it against what is then measured; and the one that
//! a reply tells against the least of the time it tells of.

use halfstep_tests::mechanism;
use halfstep_tests::walking::Walking;
use interface::{Command, Mode};

use crate::cores::on_all_cores;
use crate::streams::Source;
use crate::table;
use crate::watched::{BETWEEN_SWAPS, Watched};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How many random streams
    #[arg(long, default_value_t = 20)]
    seeds: u64,
    /// How long each
    #[arg(long, default_value_t = 120.0)]
    seconds: f64,
}

/// A prediction is good if it is no more than this off (m).
const GOOD: f64 = 0.01;
/// Share of the half-steps that must be predicted well.
const GOOD_SHARE: f64 = 0.95;
/// Width of the histogram's bins (m), and how many there are on each side.
const BIN: f64 = 0.005;
const BINS: i32 = 6;

/// How far ahead a reply tells (s).
const FORETOLD: f64 = 2.8;

/// What a walk gave.
#[derive(Default)]
struct Walked {
    half_steps: Vec<HalfStep>,
    /// What replies said of a time in which nothing else was asked: measured less predicted (m).
    replies: Vec<f64>,
    fell: bool,
}

/// What a reply said, until the time it tells of is over (m, s).
struct Promise {
    predicted: f64,
    measured: f64,
    until: f64,
}

/// The least margins of a half-step (m).
struct HalfStep {
    predicted: f64,
    measured: f64,
    /// Whether nothing was changed in it or in the one before.
    steady: bool,
}

pub(crate) fn survey(options: &Options) -> bool {
    let walks = on_all_cores(options.seeds as usize, |seed| walk(seed as u64, options.seconds));
    let falls = walks.iter().filter(|walk| walk.fell).count();
    let replies: Vec<f64> = walks.iter().flat_map(|walk| walk.replies.clone()).collect();
    let half_steps: Vec<HalfStep> = walks.into_iter().flat_map(|walk| walk.half_steps).collect();
    let (steady, changing): (Vec<&HalfStep>, Vec<&HalfStep>) = half_steps.iter().partition(|it| it.steady);
    let all: Vec<&HalfStep> = half_steps.iter().collect();

    println!("measured less predicted, in half-steps:");
    let groups = [&all, &steady, &changing];
    let mut rows: Vec<Vec<String>> = (-BINS - 1..=BINS)
        .map(|bin| {
            let [from, to] = [bin, bin + 1].map(|edge| f64::from(edge) * BIN * 1e3);
            let name = if bin < -BINS {
                format!("less than {to:.0} mm")
            } else if bin == BINS {
                format!("{from:.0} mm and more")
            } else {
                format!("{from:.0} to {to:.0} mm")
            };
            // What was in the air has no finite margin and belongs to the outermost bin.
            let falls_in = |it: &HalfStep| ((it.measured - it.predicted) / BIN).floor() as i32;
            let count = |group: &[&HalfStep]| {
                group.iter().filter(|it| falls_in(it).clamp(-BINS - 1, BINS) == bin).count().to_string()
            };
            std::iter::once(name).chain(groups.map(|group| count(group))).collect()
        })
        .collect();
    let row = |name: &str, tell: &dyn Fn(&[&HalfStep]) -> String| -> Vec<String> {
        std::iter::once(name.to_owned()).chain(groups.map(|group| tell(group))).collect()
    };
    rows.push(row("half-steps", &|group| group.len().to_string()));
    rows.push(row("within 10 mm %", &|group| format!("{:.1}", 100.0 * good_share(group))));
    table::print(&["", "all", "steady", "changing"], &rows);
    println!("{}", told_of_replies(replies));
    println!("{falls} falls");
    good_share(&all) >= GOOD_SHARE && falls == 0
}

/// Where what was measured lies against what replies foretold.
fn told_of_replies(mut replies: Vec<f64>) -> String {
    replies.sort_by(f64::total_cmp);
    let good = replies.iter().filter(|off| off.abs() <= GOOD).count() as f64 / replies.len().max(1) as f64;
    let at = |share: f64| replies.get((share * replies.len() as f64) as usize).map_or(f64::NAN, |off| off * 1e3);
    format!(
        "measured less foretold by a reply for {FORETOLD} s, of {} replies: within 10 mm {:.1} %, \
         5 % / median / 95 % {:.1} / {:.1} / {:.1} mm",
        replies.len(),
        100.0 * good,
        at(0.05),
        at(0.5),
        at(0.95)
    )
}

fn good_share(half_steps: &[&HalfStep]) -> f64 {
    let good = half_steps.iter().filter(|it| (it.measured - it.predicted).abs() <= GOOD).count();
    good as f64 / half_steps.len().max(1) as f64
}

/// A random stream.
fn walk(seed: u64, seconds: f64) -> Walked {
    let sole = mechanism().sole;
    let mut watched = Watched::new(Walking::begin(seed));
    let mut source = Source::new(seed);
    let mut walked = Walked::default();
    let mut promise: Option<Promise> = None;
    let none = HalfStep { predicted: f64::INFINITY, measured: f64::INFINITY, steady: true };
    let (mut present, mut index, mut command, mut changed_in) = (none, 0, Command::NOMINAL, None);
    while watched.fall.is_none() && watched.walking.time() < seconds {
        let request = source.next(watched.report.report.half_step.index);
        watched.tick(request.as_ref());
        let (report, now) = (&watched.report, watched.walking.time());
        if let Some(answer) = report.reply {
            let until = now + FORETOLD;
            promise = answer.predicted_margin.map(|predicted| Promise { predicted, measured: f64::INFINITY, until });
        }
        if let Some(Promise { predicted, measured, .. }) = promise.take_if(|promise| now >= promise.until) {
            walked.replies.push(measured - predicted);
        }
        if report.report.half_step.index != index {
            if present.predicted.is_finite() {
                walked.half_steps.push(present);
            }
            index = report.report.half_step.index;
            let steady = changed_in.is_none_or(|changed| index > changed + 2);
            present = HalfStep { predicted: f64::INFINITY, measured: f64::INFINITY, steady };
        }
        if report.command != command {
            command = report.command;
            changed_in = Some(index);
            present.steady = false;
        }
        if report.report.mode == Mode::Walking && BETWEEN_SWAPS.contains(&report.report.half_step.progress) {
            let zmp = report.report.zmp_planned;
            present.predicted = zmp.map_or(present.predicted, |zmp| present.predicted.min(sole.margin(zmp.x, zmp.y)));
            let margin = report.report.margin.unwrap_or(f64::NEG_INFINITY);
            present.measured = present.measured.min(margin);
            if let Some(promise) = &mut promise {
                promise.measured = promise.measured.min(margin);
            }
        }
    }
    walked.fell = watched.fall.is_some();
    walked
}
