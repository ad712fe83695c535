//! Computing times: inverse dynamics, a step of the plant, a tick of the controller, planning.
//!
//! All are measured in interleaved rounds, and the minimum of the rounds counts. What is shorter than reading the clock
//! is timed in batches: its quantiles are those of the batches' means.

use interface::{GaitChange, Request, Setpoint, Source};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

use controller::Controller;
use dynamics::{ArticulatedBody, Batch, LANES, NewtonEuler, Tree, ZmpJacobian, zmp};
use gait::{NominalRow, NominalTable, Start, Walk};
use model::{JointVector, Mechanism, Motion, PerJoint};
use nalgebra::{Isometry3, Vector3};
use paper::GroundSplit;
use pattern::{Gait, PatternGenerator};
use plant::Plant;
use runtime::{Scheduling, now_ns};

use crate::{BenchError, BenchReport, Machine, Ratio, Reduction, Series};

/// The walk, and options of the measurement.
#[derive(Clone, Debug)]
pub struct ComputeOptions {
    /// The robot's mechanism.
    pub mechanism: Mechanism,
    /// The robot's nominal half-step.
    pub nominal: Arc<NominalTable>,
    /// The controller's parameters.
    pub controller: controller::Parameters,
    /// The plant's parameters.
    pub plant: plant::PlantParameters,
    /// Number of rounds.
    pub rounds: u32,
    /// Length of one measurement in a round.
    pub slice: Duration,
    /// The control period (s).
    pub period: f64,
    /// Scheduling of the thread; an ordinary one is enough.
    pub scheduling: Scheduling,
}

/// A quantity to measure.
struct Work<'w> {
    series: Series,
    /// Number of calls that are timed together.
    batch: u32,
    /// Runs once, and returns the part of the time that counts (ns), or `None` for all of it.
    run: Box<dyn FnMut() -> Option<u64> + 'w>,
}

/// Length of the walk, after which it is restarted (control periods).
const WALK: u64 = 20_000;
/// Length of a part that is timed together where a single period is too short (control periods).
const PART: usize = 100;
/// Start of the walk that is not timed, in which caches and branch predictors warm up (control periods).
const WARM_UP: u64 = 2000;

/// Measures all computing times; calls `after_round` after each round.
///
/// # Errors
/// The robot cannot walk with these parameters.
pub fn compute(options: &ComputeOptions, after_round: impl Fn()) -> Result<BenchReport, BenchError> {
    let _granted = options.scheduling.request();
    let mut works = works(options)?;
    for _ in 0..options.rounds {
        for work in &mut works {
            work.turn(options.slice);
        }
        after_round();
    }
    let series: Vec<Series> = works.into_iter().map(|work| work.series).collect();
    let tick = series.iter().find(|series| series.name == TICK);
    let ratios = tick.map(|tick| Ratio {
        of: format!("p99 of {TICK}"),
        to: "its p50".to_owned(),
        number: "time".to_owned(),
        ratio: tick.quantile(0.99) / tick.quantile(0.5),
        interval: None,
        at_most: 1.5,
    });
    let notes = vec![format!("Each number is the minimum of {} interleaved rounds.", options.rounds)];
    let machine = Machine::of_this_process();
    Ok(BenchReport { what: "compute", machine, series, ratios: ratios.into_iter().collect(), notes })
}

const TICK: &str = "controller tick, walking";

/// The measured quantities, in the order of the table.
fn works(options: &ComputeOptions) -> Result<Vec<Work<'static>>, BenchError> {
    let ComputeOptions { mechanism, nominal, controller, plant, period, .. } = options.clone();
    let no_walk = |error| BenchError::new("the walk", error);
    let tree = Tree::new(&mechanism);
    let motion = motion();

    let (of_tree, mut inverse) = (tree.clone(), NewtonEuler::default());
    let newton_euler = move || {
        inverse.compute_fixed_base(&of_tree, black_box(&motion));
        black_box(zmp(&inverse.ground));
    };
    let (of_tree, mut batch, mut lane) = (tree.clone(), Batch::default(), 0);
    // One posture per call; every eighth call computes.
    let eight_at_once = move || {
        batch.set(lane, black_box(&motion));
        lane = (lane + 1) % LANES;
        if lane == 0 {
            batch.compute(&of_tree);
            black_box(std::array::from_fn::<_, LANES, _>(|lane| zmp(&batch.ground(lane))));
        }
    };
    let (of_tree, mut jacobian) = (tree.clone(), ZmpJacobian::default());
    let zmp_jacobian = move || {
        black_box(jacobian.compute_fixed_base(&of_tree, black_box(&motion)));
        black_box(&jacobian);
    };
    let of_row = |row: &NominalRow| GroundSplit { gravity: row.ground_gravity, dynamic: row.ground_dynamic };
    let (splits, mut row): (Vec<_>, _) = (nominal.rows.iter().map(of_row).collect(), 0);
    // One instant per call.
    let another_speed = move || {
        row = (row + 1) % splits.len();
        black_box(splits[row].zmp(black_box(1.2)));
    };
    let mut body = ArticulatedBody::default();
    let forward_dynamics = move || {
        let motion = black_box(&motion);
        body.set_state(&tree, &Isometry3::identity(), Vector3::x(), Vector3::y(), &motion.angles, &motion.rates);
        black_box(body.accelerations(&tree, &motion.accelerations, &JointVector::ZERO, &[]));
    };
    let mut standing = Plant::new(&mechanism, &plant, &Motion::default(), period, 1);
    let plant_period = move || {
        black_box(standing.step(black_box(&Setpoint::default())));
    };
    let walk = Walk::new(nominal.clone(), &mechanism, &controller.gait, Start::default()).map_err(no_walk)?;
    let half_step = nominal.duration;
    let mut preview = PatternGenerator::walking(&mechanism, walk.clone());
    let plan = move || {
        black_box(preview.advance(black_box(half_step)));
    };

    let start = walk.physical_motion();
    let begin = move || -> Result<(Controller, Plant), BenchError> {
        let walking = Controller::new(&mechanism, nominal.clone(), &controller, Start::default());
        Ok((
            walking.map_err(|error| BenchError::new("the walk", error))?,
            Plant::new(&mechanism, &plant, &start, period, 1),
        ))
    };
    let forecast = forecast_timed(begin()?, period);
    let plant_walking = parts_timed("plant, a control period of walking", true, begin()?, period, begin.clone());
    let both_walking = parts_timed("controller and plant, a control period", false, begin()?, period, begin.clone());
    let tick = walk_timed(begin()?, period, begin);

    Ok(vec![
        Work::batched("Newton–Euler and ZMP, one configuration", newton_euler),
        Work::batched("Newton–Euler and ZMP, of eight at once", eight_at_once),
        Work::batched("ZMP Jacobian by the joints", zmp_jacobian),
        Work::batched("ZMP for another speed, from the table's split", another_speed),
        Work::batched("forward dynamics, floating base", forward_dynamics),
        Work::batched("plant, a control period on both soles", plant_period),
        plant_walking,
        tick,
        both_walking,
        Work::single("preview, plan of a half-step", plan),
        forecast,
    ])
}

/// Times the evaluation of requests for another speed, without the ticks in between.
fn forecast_timed((mut controller, mut plant): (Controller, Plant), period: f64) -> Work<'static> {
    let mut faster = false;
    Work::new("forecast of a request", 1, move || {
        faster = !faster;
        let gait = GaitChange { speed: Some(if faster { 1.05 } else { 0.95 }), ..GaitChange::NONE };
        controller.submit(&Request { gait, ..Request::new(Source::Program) });
        let took_ns = controller.take_job().map(|mut job| {
            let began_ns = now_ns();
            job.evaluate();
            let took_ns = now_ns() - began_ns;
            controller.complete(job);
            took_ns
        });
        // A tick delivers the reply.
        let tick = controller.tick(period, Some(&plant.measure()));
        plant.step(&tick.setpoint);
        took_ns
    })
}

/// Times the ticks of a controller that walks a plant, without the plant.
fn walk_timed(
    (mut controller, mut plant): (Controller, Plant),
    period: f64,
    begin: impl Fn() -> Result<(Controller, Plant), BenchError> + 'static,
) -> Work<'static> {
    let mut ticks = 0;
    let run = move || {
        if ticks == WALK
            && let Ok(again) = begin()
        {
            (controller, plant) = again;
            ticks = 0;
        }
        ticks += 1;
        let measured = plant.measure();
        let began_ns = now_ns();
        let report = controller.tick(period, Some(black_box(&measured)));
        let took_ns = now_ns() - began_ns;
        plant.step(&report.setpoint);
        Some(took_ns)
    };
    let mut work = Work::new(TICK, 1, run);
    for _ in 0..WARM_UP {
        (work.run)();
    }
    work
}

/// Times parts of a walk: controller and plant together, or the plant `alone` with the same setpoints.
fn parts_timed(
    name: &str,
    alone: bool,
    (mut controller, mut plant): (Controller, Plant),
    period: f64,
    begin: impl Fn() -> Result<(Controller, Plant), BenchError> + 'static,
) -> Work<'static> {
    let mut setpoints = [Setpoint::default(); PART];
    let mut ticks = 0;
    Work::new(name, 1, move || {
        if ticks >= WALK
            && let Ok(again) = begin()
        {
            (controller, plant) = again;
            ticks = 0;
        }
        ticks += PART as u64;
        let mut again = plant.clone();
        let mut measured = plant.measure();
        let began_ns = now_ns();
        for played in &mut setpoints {
            *played = controller.tick(period, Some(&measured)).setpoint;
            measured = plant.step(played);
        }
        let together_ns = now_ns();
        for played in &setpoints {
            black_box(again.step(black_box(played)));
        }
        let took_ns = if alone { now_ns() - together_ns } else { together_ns - began_ns };
        Some(took_ns / PART as u64)
    })
}

impl Work<'static> {
    fn new(name: &str, batch: u32, run: impl FnMut() -> Option<u64> + 'static) -> Self {
        Self { series: Series::new("compute", name, Reduction::Minimum), batch, run: Box::new(run) }
    }

    fn single(name: &str, mut run: impl FnMut() + 'static) -> Self {
        Self::new(name, 1, move || {
            run();
            None
        })
    }

    /// A quantity that takes less than some microseconds.
    fn batched(name: &str, mut run: impl FnMut() + 'static) -> Self {
        Self::new(name, 32, move || {
            run();
            None
        })
    }

    fn turn(&mut self, length: Duration) {
        self.series.begin_round();
        let end_ns = now_ns() + length.as_nanos() as u64;
        let mut began_ns = now_ns();
        while began_ns < end_ns {
            let mut counts = None;
            for _ in 0..self.batch {
                counts = (self.run)();
            }
            let ended_ns = now_ns();
            let took_ns = counts.unwrap_or(ended_ns - began_ns);
            self.series.add(took_ns as f64 / f64::from(self.batch));
            began_ns = now_ns();
        }
    }
}

/// A motion that differs in every joint, so that nothing is a special case.
fn motion() -> Motion {
    let spread = |size: f64| PerJoint::from_fn(|joint| size * (f64::from(joint.number()) * 0.7).sin());
    Motion { angles: spread(0.5), rates: spread(2.0), accelerations: spread(-10.0) }
}
