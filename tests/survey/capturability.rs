//! Whether the report is right about who can still be kept from falling: random pushes around what a walk survives.

use halfstep_tests::pushing::{PUSH_DURATION, WALKS_ON, at_angle, survives_at, walk_to};
use halfstep_tests::walking::Walking;
use interface::{Capturability, Mode};
use rand::{Rng, SeedableRng, rngs::StdRng};

use crate::cores::on_all_cores;
use crate::pushes::largest_survived;
use crate::{asked, table};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Random pushes
    #[arg(long, default_value_t = 1000)]
    pushes: usize,
    /// Share of pushes that must be judged rightly within 0.1 s after the first touchdown
    #[arg(long, default_value_t = 0.98)]
    demanded: f64,
}

/// Steps and resolution of the search for the limit of each push (N·s).
const STEP: f64 = 4.0;
const RESOLUTION: f64 = 2.0;
/// The pushes, as shares of their limits.
const SHARES: std::ops::Range<f64> = 0.5..1.5;
/// How long before the fall it must be reported for good to be foreseen (s): from then on a robot that falls over is on
/// its way down anyway.
const FORESEEN: f64 = 0.2;
/// When the report is asked: at which touchdown after the push, and how many ticks after it.
const AFTER_TOUCHDOWN: [(usize, u64); 5] = [(1, 1), (1, 50), (1, 100), (2, 1), (3, 1)];

/// What became of a push.
struct Pushed {
    /// Of its limit.
    share: f64,
    /// Whether the robot fell.
    has_fallen: bool,
    /// What was reported at each of [`AFTER_TOUCHDOWN`]; the last report stays.
    judged: [Capturability; AFTER_TOUCHDOWN.len()],
    /// If it fell: time from when the report changed to [`Capturability::Lost`] for the last time until then (s).
    foreseen: Option<f64>,
}

pub(crate) fn survey(options: &Options) -> bool {
    let pushed: Vec<Pushed> = on_all_cores(options.pushes, push).into_iter().flatten().collect();
    let mut rows = Vec::new();
    for (place, (touchdown, ticks)) in AFTER_TOUCHDOWN.into_iter().enumerate() {
        let mut counts = [[0_u32; 2]; 2];
        for push in &pushed {
            counts[usize::from(push.has_fallen)][usize::from(push.judged[place] == Capturability::Lost)] += 1;
        }
        let [[caught, false_alarm], [missed, foreseen]] = counts;
        let right = f64::from(caught + foreseen) / pushed.len() as f64;
        let when = format!("touchdown {touchdown} + {ticks} ms");
        let counts = [caught, false_alarm, missed, foreseen].map(|count| count.to_string());
        rows.push([vec![when], counts.to_vec(), vec![format!("{:.1} %", 100.0 * right)]].concat());
    }
    println!("{} pushes of {SHARES:?} of what is survived:", pushed.len());
    table::print(
        &["reported at", "caught", "caught, reported lost", "fell, not reported", "fell, reported lost", "right"],
        &rows,
    );
    by_share(&pushed);
    let mut warnings: Vec<f64> = pushed.iter().filter_map(|push| push.foreseen).collect();
    warnings.sort_by(f64::total_cmp);
    let foreseen = warnings.iter().filter(|before| **before >= FORESEEN).count();
    let median = warnings.get(warnings.len() / 2).copied().unwrap_or_default();
    let falls = warnings.len();
    println!("{foreseen} of {falls} falls were foreseen by {FORESEEN} s or more, half of them by {median:.2} s");
    let right = pushed.iter().filter(|push| push.has_fallen == (push.judged[2] == Capturability::Lost)).count();
    right as f64 >= options.demanded * pushed.len() as f64 && foreseen == falls
}

/// How often the report is right 0.1 s after the first touchdown, by how hard the push was.
fn by_share(pushed: &[Pushed]) {
    let rows: Vec<Vec<String>> = (0..5)
        .map(|fifth| {
            let from = SHARES.start + (SHARES.end - SHARES.start) * f64::from(fifth) / 5.0;
            let to = from + (SHARES.end - SHARES.start) / 5.0;
            let those: Vec<&Pushed> = pushed.iter().filter(|push| (from..to).contains(&push.share)).collect();
            let falls = those.iter().filter(|push| push.has_fallen).count();
            let right = those.iter().filter(|push| push.has_fallen == (push.judged[2] == Capturability::Lost)).count();
            let percent = |count: usize| format!("{:.0} %", 100.0 * count as f64 / those.len().max(1) as f64);
            vec![format!("{from:.1} to {to:.1}"), those.len().to_string(), percent(falls), percent(right)]
        })
        .collect();
    table::print(&["share of the limit", "pushes", "fall", "right"], &rows);
}

/// A random push of a random walk; `None` if that falls before.
fn push(index: usize) -> Option<Pushed> {
    let mut random = StdRng::seed_from_u64(index as u64);
    let request = asked::request(random.random_range(0.8..1.2), random.random_range(-15.0..15.0), 0.0);
    let (half_step, progress) = (random.random_range(7..9), random.random_range(0.0..1.0));
    let angle = random.random_range(0.0..std::f64::consts::TAU);
    let share = random.random_range(SHARES);
    let walking = walk_to(random.random_range(0..1000), request, half_step, progress)?;
    let limit = largest_survived(STEP, RESOLUTION, |impulse| survives_at(&walking, angle, impulse));
    Some(watch(walking, angle, share * limit, share))
}

/// Pushes a walk, and compares what is reported with what comes.
fn watch(mut walking: Walking, angle: f64, impulse: f64, share: f64) -> Pushed {
    let report = walking.tick(None).report;
    let push = at_angle(&walking, report.half_step.support, angle) * impulse;
    walking.plant.push(push, PUSH_DURATION);
    let (begin, mut half_step) = (walking.time(), report.half_step.index);
    let (mut touchdowns, mut since) = (0, 0);
    let mut judged = [Capturability::ByAnkles; AFTER_TOUCHDOWN.len()];
    let mut lost_since = None;
    while walking.time() < begin + WALKS_ON {
        let tick = walking.tick(None);
        let now = walking.time() - begin;
        if tick.report.half_step.index != half_step {
            half_step = tick.report.half_step.index;
            // A foot that lands while the push lasts was not chosen after it.
            if touchdowns > 0 || now > PUSH_DURATION {
                (touchdowns, since) = (touchdowns + 1, 0);
            }
        }
        since += 1;
        let seen = tick.report.capturability.unwrap_or(Capturability::Lost);
        for (judged, (touchdown, ticks)) in judged.iter_mut().zip(AFTER_TOUCHDOWN) {
            if touchdowns < touchdown || (touchdowns == touchdown && since <= ticks) {
                *judged = seen;
            }
        }
        lost_since = (seen == Capturability::Lost).then(|| lost_since.unwrap_or(now));
        if walking.has_fallen(&tick) || tick.report.mode == Mode::Fallen {
            return Pushed { share, has_fallen: true, judged, foreseen: lost_since.map(|since| now - since) };
        }
    }
    Pushed { share, has_fallen: false, judged, foreseen: None }
}
