//! Trials: the robot simulated with its controller, in lockstep in this process, from a stand to pushes.

use std::sync::Arc;

use controller::{Controller, Driver, InlineWorker, Tick};
use gait::{NominalTable, Start, Walk, WalkError};
use interface::{Fault, GaitChange, Intent, Mode, Rejection, Report, Request, Source, Verdict};
use model::Mechanism;
use nalgebra::Vector3;
use pattern::PatternGenerator;
use plant::{Plant, Push, Truth};

use crate::examined_robot::{ExaminedRobot, RobotSetup};

/// Something that the robot is asked to do, and what must come of it.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Name of the check.
    pub name: &'static str,
    /// Whether it begins in a stand, and not in mid-walk.
    pub from_stand: bool,
    /// What is asked, and when (s).
    pub asks: &'static [(f64, Ask)],
    /// How long it lasts (s).
    pub lasts: f64,
    /// What the robot must be doing at the end.
    pub ends: Mode,
    /// Whether it is pushed.
    pub is_pushed: bool,
}

/// A request.
#[derive(Clone, Copy, Debug)]
pub enum Ask {
    /// Another intent.
    Intent(Intent),
    /// Another speed (-).
    Speed(f64),
    /// Another turn (rad).
    Turn(f64),
}

use Ask::{Intent as Do, Speed, Turn};

const fn trial(name: &'static str, from_stand: bool, asks: &'static [(f64, Ask)], lasts: f64, ends: Mode) -> Trial {
    Trial { name, from_stand, asks, lasts, ends, is_pushed: false }
}

/// The trials, each of which needs what those before it show.
pub const TRIALS: [Trial; 7] = [
    trial("stand", true, &[], 3.0, Mode::Standing),
    trial("first steps, in place", true, &[(0.5, Do(Intent::InPlace))], 6.0, Mode::InPlace),
    trial("slow walk", true, &[(0.5, Speed(0.7)), (0.6, Do(Intent::Walk))], 8.0, Mode::Walking),
    trial("nominal walk", false, &[], 8.0, Mode::Walking),
    trial(
        "changes of speed and turn",
        false,
        &[(2.0, Speed(1.25)), (5.0, Speed(0.8)), (7.5, Turn(0.2))],
        10.0,
        Mode::Walking,
    ),
    trial(
        "stop and start",
        false,
        &[(1.0, Do(Intent::Stop)), (4.0, Do(Intent::Walk)), (6.5, Do(Intent::Hold)), (9.0, Do(Intent::Walk))],
        12.0,
        Mode::Walking,
    ),
    Trial { is_pushed: true, ..trial("small pushes", false, &[], 12.0, Mode::Walking) },
];

/// When the robot is pushed (s), and where to: ahead, left.
const PUSHES: [(f64, [f64; 2]); 4] = [(2.4, [1.0, 0.0]), (4.7, [0.0, 1.0]), (7.0, [-1.0, 0.0]), (9.3, [0.0, -1.0])];
/// A push, per `m·√(g·leg)`, and how long it lasts (s): 3 N·s for the paper's robot.
const IMPULSE: f64 = 0.014;
const PUSH_LASTS: f64 = 0.1;
/// Time at the beginning of a trial that does not count: sensors settle (s).
const SETTLES: f64 = 0.3;

/// Progress of a half-step between which errors count: at a support change the ZMP moves from foot to foot.
const OFF_SUPPORT_CHANGES: std::ops::Range<f64> = 0.25..0.75;

/// What came of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct TrialOutcome {
    /// When the robot fell (s).
    pub fell_at: Option<f64>,
    /// The fault that stopped it.
    pub stopped_by: Option<String>,
    /// When a sample was first rejected (s), and why; then how many were.
    pub rejected: Option<(f64, Rejection)>,
    /// Number of rejected samples.
    pub rejections: u64,
    /// What the robot did at the end.
    pub mode: Mode,
    /// The first request that was not accepted as it was asked.
    pub cut: Option<&'static str>,
    /// Mean distance of the measured ZMP from the planned one, off the support changes, as the root of the mean
    /// square (m).
    pub zmp_error: f64,
    /// The same of the centre of mass, seen from above (m).
    pub com_error: f64,
    /// Mean rate of the ankle's lean by feedback, as the root of the mean square (rad/s).
    pub shaking: f64,
}

/// A control period of a trial.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Time since the beginning (s).
    pub time: f64,
    /// What the controller reports.
    pub report: Report,
    /// The true state of the robot.
    pub truth: Truth,
}

/// A controller and a robot in one process.
struct Pair {
    driver: Driver<InlineWorker>,
    plant: Plant,
}

impl Trial {
    /// Runs the trial with a setup.
    ///
    /// # Errors
    /// The half-step cannot be walked with these limits at all.
    pub fn run(&self, examined: &ExaminedRobot, setup: &RobotSetup) -> Result<TrialOutcome, WalkError> {
        self.watch(examined, setup, |_| ())
    }

    /// The same, each period of which is shown to `look`.
    ///
    /// # Errors
    /// As for [`run`](Self::run).
    pub fn watch(
        &self,
        examined: &ExaminedRobot,
        setup: &RobotSetup,
        look: impl FnMut(&Moment),
    ) -> Result<TrialOutcome, WalkError> {
        let mut pair = Pair::begin(setup, &examined.nominal, examined.period, self.from_stand)?;
        if self.is_pushed {
            let size = IMPULSE * examined.impulse_unit();
            pair.plant.disturbances.pushes.extend(PUSHES.iter().map(|(start, [ahead, left])| Push {
                link: Mechanism::TRUNK,
                impulse: Vector3::new(*ahead, *left, 0.0) * size,
                start: *start,
                duration: PUSH_LASTS,
            }));
        }
        Ok(self.play(&mut pair, examined.period, look))
    }

    fn play(&self, Pair { driver, plant }: &mut Pair, period: f64, mut look: impl FnMut(&Moment)) -> TrialOutcome {
        let mut measurement = plant.measure();
        let mut asks = self.asks.iter().peekable();
        let mut outcome = TrialOutcome {
            fell_at: None,
            stopped_by: None,
            rejected: None,
            rejections: 0,
            mode: Mode::Standing,
            cut: None,
            zmp_error: 0.0,
            com_error: 0.0,
            shaking: 0.0,
        };
        let (mut zmp, mut com, mut lean) = (Mean::default(), Mean::default(), Mean::default());
        let mut last_lean = None;
        for tick in 0..(self.lasts / period).round() as u64 {
            let time = tick as f64 * period;
            let step = driver.step(period, Some(&measurement), |_| {
                asks.next_if(|(at, _)| time >= *at).map(|(_, ask)| ask.request())
            });
            let Tick { setpoint, report, rejection, reply, latched, .. } = step.tick;
            measurement = plant.step(&setpoint);
            if reply.is_some_and(|reply| reply.verdict != Verdict::Accepted) {
                outcome.cut = outcome.cut.or(Some(self.name));
            }
            if let Some(rejection) = rejection.filter(|_| time > SETTLES) {
                outcome.rejected.get_or_insert((time, rejection));
                outcome.rejections += 1;
            }
            outcome.mode = report.mode;
            if let Some(fault) = latched.filter(|latched| latched.fault != Fault::Fallen) {
                outcome.stopped_by.get_or_insert(fault.to_string());
            }
            if report.mode == Mode::Fallen || plant.truth().has_fallen() || plant.instability().is_some() {
                outcome.fell_at = Some(time);
                break;
            }
            look(&Moment { time, report, truth: plant.truth() });
            let is_standing = matches!(report.mode, Mode::Standing | Mode::Holding);
            if !is_standing && !OFF_SUPPORT_CHANGES.contains(&report.half_step.progress) {
                continue;
            }
            if let (Some(measured), Some(planned)) = (report.zmp_in_support, report.zmp_planned) {
                zmp.add((measured - planned).norm_squared());
            }
            if let (Some(measured), Some(planned)) = (report.com_measured, report.com_planned) {
                com.add((measured.position - planned.position).xy().norm_squared());
            }
            if let Some(before) = last_lean.replace((report.lean, report.half_step.index))
                && before.1 == report.half_step.index
            {
                lean.add(((report.lean - before.0) / period).norm_squared());
            }
        }
        TrialOutcome { zmp_error: zmp.root(), com_error: com.root(), shaking: lean.root(), ..outcome }
    }
}

impl Pair {
    fn begin(
        setup: &RobotSetup,
        nominal: &Arc<NominalTable>,
        period: f64,
        from_stand: bool,
    ) -> Result<Self, WalkError> {
        let RobotSetup { mechanism, controller, plant } = setup;
        let walk = Walk::new(Arc::clone(nominal), mechanism, &controller.gait, Start::default())?;
        let (begin, start) = if from_stand {
            let start = PatternGenerator::standing(mechanism, walk).physical_motion();
            (Controller::standing as fn(&_, _, &_, _) -> _, start)
        } else {
            (Controller::new as fn(&_, _, &_, _) -> _, walk.physical_motion())
        };
        let controller = begin(mechanism, Arc::clone(nominal), controller, Start::default())?;
        let driver = Driver { controller, worker: InlineWorker };
        Ok(Self { driver, plant: Plant::new(mechanism, plant, &start, period, 1) })
    }
}

impl Ask {
    fn request(self) -> Request {
        let nothing = Request::new(Source::Console);
        let change = |gait| Request { gait, ..nothing };
        match self {
            Do(intent) => Request { intent: Some(intent), ..nothing },
            Speed(speed) => change(GaitChange { speed: Some(speed), ..GaitChange::NONE }),
            Turn(turn) => change(GaitChange { turn: Some(turn), ..GaitChange::NONE }),
        }
    }
}

/// A mean that grows.
#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    sum: f64,
    count: u64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
    }

    fn root(self) -> f64 {
        (self.sum / self.count.max(1) as f64).sqrt()
    }
}
