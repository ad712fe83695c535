//! Agreement: the same random scenarios in our own plant and in MuJoCo. Half of them are hard: no compensation, the
//! paper's constant lean, pushes, low friction. Do both fall, or none? And how far apart are the zero-moment points of
//! nominal walks?

use interface::{Measurement, Setpoint};
use std::fmt;

use controller::Compensation;
use dynamics::Tree;
use gait::at_speed;
use halfstep_tests::walking::{PERIOD, Walking, controller_parameters, nominal, plant_parameters};
use halfstep_tests::{mechanism, random};
use model::Joint;
use nalgebra::Vector2;
use paper::{LeanAt, PaperLean};
use plant::{Disturbances, Plant, Push};
use rand::Rng;

use crate::cores::on_all_cores;
use crate::mujoco::{Outside, start};
use crate::playback::Playback;
use crate::streams::Source;
use crate::watched::Watched;
use crate::{asked, table};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How many scenarios
    #[arg(long, default_value_t = 200)]
    scenarios: usize,
    /// How long each (s)
    #[arg(long, default_value_t = 20.0)]
    seconds: f64,
    /// How many nominal walks are compared by their ZMP
    #[arg(long, default_value_t = 5)]
    nominal_walks: usize,
}

/// Share of the scenarios whose outcome must be the same.
const AGREEING: f64 = 0.9;
/// How far apart the ZMPs of nominal walks may be, as a root mean square (m).
const APART: f64 = 0.015;

/// What is different in a scenario.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// A stream of requests on a floor and with masses that vary a little.
    Ordinary,
    /// No compensation, no feedback, at a speed.
    Uncompensated(f64),
    /// The computed constant lean at a speed, with feedback.
    Lean(LeanAt, f64),
    /// A push at a time, with a stream (N·s, s).
    Push(Vector2<f64>, f64),
    /// Low friction, with a stream.
    Slippery(f64),
}

/// When it fell in our plant and in MuJoCo (s).
struct Outcome {
    kind: Kind,
    falls: [Option<f64>; 2],
}

pub(crate) fn survey(options: &Options) -> bool {
    let outcomes = on_all_cores(options.scenarios, |index| {
        let kind = Kind::of(index as u64);
        let falls = [false, true].map(|in_mujoco| kind.falls(index as u64, options.seconds, in_mujoco));
        Outcome { kind, falls }
    });
    let group = |name: &str, of: fn(&Kind) -> bool| {
        let group: Vec<&Outcome> = outcomes.iter().filter(|outcome| of(&outcome.kind)).collect();
        let count = |what: &dyn Fn(&Outcome) -> bool| group.iter().filter(|outcome| what(outcome)).count().to_string();
        vec![
            name.to_owned(),
            group.len().to_string(),
            count(&Outcome::agrees),
            count(&|outcome| outcome.falls[0].is_some()),
            count(&|outcome| outcome.falls[1].is_some()),
        ]
    };
    table::print(
        &["scenarios", "of them", "agree", "fall in our plant", "fall in MuJoCo"],
        &[
            group("ordinary", |kind| matches!(kind, Kind::Ordinary)),
            group("uncompensated", |kind| matches!(kind, Kind::Uncompensated(_))),
            group("constant lean", |kind| matches!(kind, Kind::Lean(..))),
            group("pushes", |kind| matches!(kind, Kind::Push(..))),
            group("low friction", |kind| matches!(kind, Kind::Slippery(_))),
            group("all", |_| true),
        ],
    );
    for (index, outcome) in outcomes.iter().enumerate().filter(|(_, outcome)| !outcome.agrees()) {
        println!("scenario {index}: {outcome}");
    }
    let share = outcomes.iter().filter(|outcome| outcome.agrees()).count() as f64 / outcomes.len().max(1) as f64;

    let apart = on_all_cores(options.nominal_walks, |index| zmp_apart(index as u64, options.seconds));
    let told: Vec<String> = apart.iter().map(|apart| format!("{:.1}", apart * 1e3)).collect();
    println!("{:.1} % agree; ZMP of nominal walks apart by {} mm RMS", 100.0 * share, told.join(", "));
    share >= AGREEING && apart.iter().all(|apart| *apart <= APART)
}

impl Kind {
    /// By the scenario's number: every other one is ordinary.
    fn of(seed: u64) -> Self {
        let mut random = random(seed);
        let speed = random.random_range(0.6..=1.4);
        match seed % 8 {
            1 => Kind::Uncompensated(speed),
            3 => Kind::Lean(if random.random() { LeanAt::Ankle } else { LeanAt::Trunk }, speed),
            5 => {
                let direction = random.random_range(0.0..std::f64::consts::TAU);
                let impulse = random.random_range(5.0..50.0);
                let at = random.random_range(4.0..8.0);
                Kind::Push(Vector2::new(direction.cos(), direction.sin()) * impulse, at)
            }
            7 => Kind::Slippery(random.random_range(0.05..0.4)),
            _ => Kind::Ordinary,
        }
    }

    /// When it falls (s).
    fn falls(self, seed: u64, seconds: f64, in_mujoco: bool) -> Option<f64> {
        let mechanism = mechanism();
        let (mut controller, mut plant) = (controller_parameters(), plant_parameters());
        let mut disturbances = Disturbances::default();
        let mut random = random(seed + 1000);
        match self {
            Kind::Ordinary => {
                plant.contact.friction = random.random_range(0.5..1.0);
                plant.mass_error = random.random_range(0.0..0.05);
                plant.slope.ahead = random.random_range(-0.03..0.03);
                plant.slope.left = random.random_range(-0.03..0.03);
            }
            Kind::Uncompensated(_) => {
                controller.compensation = Compensation::None;
                controller.stabilizer.feedback.gain = 0.0;
            }
            Kind::Lean(at, speed) => return lean(at, speed, seconds, in_mujoco),
            Kind::Push(impulse, start) => {
                disturbances.pushes.push(Push {
                    link: Joint::WaistRoll,
                    impulse: impulse.push(0.0),
                    start,
                    duration: 0.1,
                });
            }
            Kind::Slippery(friction) => plant.contact.friction = friction,
        }
        let mut step = physics(
            in_mujoco.then(|| Outside::begin(&mechanism, &plant, &disturbances, &start(&mechanism, &controller), seed)),
        );
        let mut walking = Walking::begin_with(&mechanism, &controller, &plant, seed);
        walking.plant.disturbances = disturbances;
        let mut watched = Watched::begin_in(walking, &mut step);
        let mut source = Source::new(seed);
        while watched.fall.is_none() && watched.walking.time() < seconds {
            let half_step = watched.report.report.half_step.index;
            let request = match self {
                Kind::Uncompensated(speed) => (half_step == 4).then(|| asked::request(speed, 0.0, 0.0)),
                _ => source.next(half_step),
            };
            watched.tick_in(request.as_ref(), &mut step);
        }
        watched.fall.map(|fall| fall.time)
    }
}

/// The plant's own physics, or another engine's.
fn physics(mut outside: Option<Outside>) -> impl FnMut(&mut Plant, &Setpoint) -> Measurement {
    move |plant, setpoint| match &mut outside {
        Some(outside) => outside.step(plant, setpoint),
        None => plant.step(setpoint),
    }
}

/// When the steady walk with the computed constant lean falls (s).
fn lean(at: LeanAt, speed: f64, seconds: f64, in_mujoco: bool) -> Option<f64> {
    let (mechanism, table, controller, plant) = (mechanism(), nominal(), controller_parameters(), plant_parameters());
    let motions: Vec<_> = table.rows.iter().map(|row| at_speed(&row.motion, speed, 0.0)).collect();
    let best = PaperLean::best(&Tree::new(&mechanism), &mechanism.sole, at, &motions);
    let feedback = controller.stabilizer.feedback;
    let mut walk = Playback::begin(&mechanism, table, &controller.gait, &plant, feedback, speed, best);
    let outside = in_mujoco.then(|| Outside::begin(&mechanism, &plant, &Disturbances::default(), &walk.start, 0));
    walk.falls_in(seconds, physics(outside))
}

/// Root mean square of the distance of both plants' ZMP, as the controller senses it, over a nominal walk (m).
fn zmp_apart(seed: u64, seconds: f64) -> f64 {
    let (mechanism, controller, plant) = (mechanism(), controller_parameters(), plant_parameters());
    let traces = [false, true].map(|in_mujoco| -> Vec<Option<Vector2<f64>>> {
        let start = start(&mechanism, &controller);
        let mut step =
            physics(in_mujoco.then(|| Outside::begin(&mechanism, &plant, &Disturbances::default(), &start, seed)));
        let mut walking = Walking::begin_with(&mechanism, &controller, &plant, seed);
        (0..(seconds / PERIOD) as usize).map(|_| walking.tick_in(None, &mut step).report.zmp_in_support).collect()
    });
    let [ours, theirs] = &traces;
    let apart: Vec<f64> = std::iter::zip(ours, theirs)
        .filter_map(|(ours, theirs)| Some((ours.as_ref()? - theirs.as_ref()?).norm_squared()))
        .collect();
    (apart.iter().sum::<f64>() / apart.len() as f64).sqrt()
}

impl Outcome {
    fn agrees(&self) -> bool {
        self.falls[0].is_some() == self.falls[1].is_some()
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let told = self.falls.map(|fall| fall.map_or("walks".to_owned(), |time| format!("falls at {time:.1} s")));
        write!(f, "{:?}: {} in our plant, {} in MuJoCo", self.kind, told[0], told[1])
    }
}
