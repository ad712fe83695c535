//! Controller and plant that walk in one thread, in the order of two processes in lockstep.
//!
//! The parts are those of the processes: [`Driver::step`] with the [`RequestSchedule`], and the plant's [`Obedience`].
//! What is left is who comes first: the plant's measurement 0; then in each period the controller, which answers
//! measurement `k` with setpoint `k`, and the plant, which answers that with measurement `k + 1`.

use std::collections::VecDeque;
use std::convert::Infallible;

use controller::{Controller, Driver, DueRequest, InlineWorker, RequestAnswer, RequestId, RequestSchedule, Tick};
use gait::{Start, WalkError};
use interface::{Measurement, PushOutcome, PushRequest, Rate, Request, SetpointHash};
use model::JointVector;
use pattern::PatternGenerator;
use plant::{Disturbances, Obedience, Plant, Push};

use crate::WalkableRobot;

/// Requests of a script that are taken in at a time.
const AHEAD: usize = 16;

/// With what a walk begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LockstepOptions {
    /// Of sensor noise and mass errors.
    pub seed: u64,
    /// The control rate.
    pub rate: Rate,
    /// Whether it begins in a stand, else in stride.
    pub from_stand: bool,
}

impl Default for LockstepOptions {
    /// A stand, at the rate of `config/realtime.toml`.
    fn default() -> Self {
        Self { seed: 0, rate: Rate::clamped(1000), from_stand: true }
    }
}

/// A walk of controller and plant.
#[derive(Clone, Debug)]
pub struct LockstepWalk {
    driver: Box<Driver<InlineWorker>>,
    plant: Box<Plant>,
    obedience: Obedience,
    schedule: Box<RequestSchedule>,
    /// Requests with later ticks, in their order.
    later: VecDeque<Request>,
    newest: RequestId,
    measurement: Measurement,
    tick: u64,
    rate: Rate,
    setpoints: SetpointHash,
}

impl LockstepWalk {
    /// A robot that stands, as with `--from-stand --lockstep`, or begins in stride.
    ///
    /// * `requests` – in the order of their ticks
    /// * `disturbances` – of the plant
    ///
    /// # Errors
    /// The robot cannot walk by its half-step.
    pub fn new(
        robot: &WalkableRobot,
        options: &LockstepOptions,
        requests: impl IntoIterator<Item = Request>,
        disturbances: Disturbances,
    ) -> Result<Self, WalkError> {
        let WalkableRobot { robot, controller, plant } = robot;
        let LockstepOptions { seed, rate, from_stand } = *options;
        let controller = controller.for_lockstep();
        let start = if from_stand {
            PatternGenerator::standing_motion(robot, &controller.gait)?
        } else {
            robot.nominal.at(0.0)
        };
        let mut plant = Box::new(Plant::new(&robot.mechanism, plant, &start, rate.period_s(), seed));
        plant.disturbances = disturbances;
        plant.disturbances.make_room();
        let begin = if from_stand { Controller::standing } else { Controller::new };
        let controller = begin(&robot.mechanism, robot.nominal.clone(), &controller, Start::default())?;
        Ok(Self {
            driver: Box::new(Driver { controller, worker: InlineWorker }),
            obedience: Obedience::of(&plant),
            schedule: Box::default(),
            later: requests.into_iter().collect(),
            newest: RequestId::default(),
            measurement: plant.measure(),
            plant,
            tick: 0,
            rate,
            setpoints: SetpointHash::default(),
        })
    }

    /// The control rate.
    pub fn rate(&self) -> Rate {
        self.rate
    }

    /// The simulated robot.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// The period that comes next, counted from 0: how many have been walked.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// Of the setpoints of all periods so far.
    pub fn setpoints(&self) -> SetpointHash {
        self.setpoints
    }

    /// The newest measurement.
    pub fn measurement(&self) -> &Measurement {
        &self.measurement
    }

    /// Whether the simulation has become unstable, in words.
    pub fn instability(&self) -> Option<String> {
        self.plant.instability().map(|instability| instability.to_string())
    }

    /// Requests something for the next period. Replies to requests that it overrides go to `answer`.
    pub fn request(&mut self, request: &Request, answer: &mut impl FnMut(RequestAnswer)) -> RequestId {
        self.add(Request { not_before: self.tick, ..*request }, answer)
    }

    fn add(&mut self, request: Request, answer: &mut impl FnMut(RequestAnswer)) -> RequestId {
        self.newest = self.newest.next();
        self.schedule.add(DueRequest { id: self.newest, request }, answer);
        self.newest
    }

    /// Adds an angle to each joint's setpoint from the next period on (rad), see [`Controller::set_joint_residual`].
    pub fn set_joint_residual(&mut self, residual: &JointVector) {
        self.driver.controller.set_joint_residual(residual);
    }

    /// Begins a push, and returns it as a script of disturbances has it.
    ///
    /// # Errors
    /// Why there is none.
    pub fn push(&mut self, push: &PushRequest) -> Result<Push, PushOutcome> {
        self.plant.begin_push(push)
    }

    /// The plant's time (s).
    pub fn time(&self) -> f64 {
        self.plant.time()
    }

    /// Walks on by one period. Replies go to `answer`.
    pub fn step(&mut self, answer: &mut impl FnMut(RequestAnswer)) -> Tick {
        while self.schedule.waiting().count() < AHEAD
            && let Some(request) = self.later.pop_front()
        {
            self.add(request, answer);
        }
        let Self { driver, plant, obedience, schedule, tick: next_tick, rate, .. } = self;
        let mut submitted = None;
        let step = driver.step(rate.period_s(), Some(&self.measurement), |urgent_only| {
            submitted = schedule.due(*next_tick, 0, urgent_only, answer);
            submitted.map(|due| due.request)
        });
        schedule.conclude(submitted, &step.tick, answer);
        self.setpoints.add(&step.tick.setpoint);

        obedience.hear(&step.tick.setpoint);
        let moved = obedience.obey(plant, |plant, setpoint| Ok::<_, Infallible>(plant.step(setpoint)));
        let Ok(measurement) = moved;
        self.measurement = measurement;
        *next_tick += 1;
        step.tick
    }
}
