//! Controller and plant walking together in one process, in lockstep.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;

use config::Config;
use controller::{Controller, Driver, InlineWorker, Tick};
use gait::{Limits, NominalTable, Start, Walk};
use interface::{GaitChange, Intent, Measurement, Mode, Request, Setpoint, Source};
use model::{Mechanism, Motion};
use pattern::PatternGenerator;
use plant::{Plant, Truth};

use crate::repository;

/// Control period of all walks (s).
pub const PERIOD: f64 = 1e-3;

/// Requests that can wait without an allocation.
const WAITING: usize = 16;

/// No answer takes so long (ticks).
const ANSWERED_WITHIN: u32 = 1000;

/// `config/nominal_half_step.csv`.
pub fn nominal() -> Arc<NominalTable> {
    let file = repository().join("config/nominal_half_step.csv");
    Arc::new(NominalTable::read_csv(&file).expect("the committed nominal loads"))
}

/// `config/controller.toml`.
pub fn controller_parameters() -> controller::Parameters {
    controller::Parameters::load(repository().join("config/controller.toml")).expect("the committed file loads")
}

/// The range of gait parameters of the first acceptance runs: forward, on which the paper's figures look, without
/// sidesteps. The committed one is wider.
pub fn first_range() -> Limits {
    Limits {
        turn_max: 30_f64.to_radians(),
        speed_min: 0.5,
        speed_max: 1.5,
        extension_min: -8_f64.to_radians(),
        extension_max: 12_f64.to_radians(),
        sidestep_max: 0.0,
    }
}

/// `config/plant.toml`.
pub fn plant_parameters() -> plant::PlantParameters {
    plant::PlantParameters::load(repository().join("config/plant.toml")).expect("the committed file loads")
}

/// Physical joints of the stand from which a walk is started.
pub fn standing(mechanism: &Mechanism, parameters: &controller::Parameters) -> Motion {
    standing_by(mechanism, nominal(), parameters)
}

/// The same with another half-step.
fn standing_by(mechanism: &Mechanism, table: Arc<NominalTable>, parameters: &controller::Parameters) -> Motion {
    let walk = Walk::new(table, mechanism, &parameters.gait, Start::default()).expect("the nominal walks");
    PatternGenerator::standing(mechanism, walk).physical_motion()
}

/// A controller and a plant that walk together. A clone walks on by itself, to the same bits.
#[derive(Clone, Debug)]
pub struct Walking {
    /// The controller with its worker.
    pub driver: Box<Driver<InlineWorker>>,
    /// The simulated robot.
    pub plant: Box<Plant>,
    /// The newest measurement.
    pub measurement: Measurement,
    tick: u64,
    /// Requests that wait until those before are replied to.
    waiting: VecDeque<Request>,
}

impl Walking {
    /// At the beginning of the nominal half-step, with the committed configuration.
    pub fn begin(seed: u64) -> Self {
        Self::begin_with(&crate::mechanism(), &controller_parameters(), &plant_parameters(), seed)
    }

    /// The same with other parameters.
    pub fn begin_with(
        mechanism: &Mechanism,
        controller: &controller::Parameters,
        plant: &plant::PlantParameters,
        seed: u64,
    ) -> Self {
        Self::begin_by(mechanism, nominal(), controller, plant, seed)
    }

    /// The same with another half-step.
    pub fn begin_by(
        mechanism: &Mechanism,
        table: Arc<NominalTable>,
        controller: &controller::Parameters,
        plant: &plant::PlantParameters,
        seed: u64,
    ) -> Self {
        let start = Walk::new(table.clone(), mechanism, &controller.gait, Start::default())
            .expect("the nominal walks")
            .physical_motion();
        let plant = Plant::new(mechanism, plant, &start, PERIOD, seed);
        let controller = Controller::new(mechanism, table, controller, Start::default()).expect("the nominal walks");
        let driver = Driver { controller, worker: InlineWorker };
        Self::new(driver, plant)
    }

    /// A robot at the beginning of the half-step of its configuration folder, as `halfstep import` writes one.
    pub fn of_robot(folder: &Path, seed: u64) -> Self {
        let file = |name: &str| folder.join(name);
        let mechanism = Mechanism::load(file("mechanism.toml")).unwrap_or_else(|error| panic!("{error}"));
        let table = NominalTable::read_csv(&file("nominal_half_step.csv")).unwrap_or_else(|error| panic!("{error}"));
        let controller =
            controller::Parameters::load(file("controller.toml")).unwrap_or_else(|error| panic!("{error}"));
        let plant = plant::PlantParameters::load(file("plant.toml")).unwrap_or_else(|error| panic!("{error}"));
        Self::begin_by(&mechanism, Arc::new(table), &controller, &plant, seed)
    }

    fn new(driver: Driver<InlineWorker>, mut plant: Plant) -> Self {
        let measurement = plant.measure();
        // Boxed: some copies would fill the stack of a test.
        let (driver, plant) = (Box::new(driver), Box::new(plant));
        Self { driver, plant, measurement, tick: 0, waiting: VecDeque::with_capacity(WAITING) }
    }

    /// In a stand, as with `--from-stand`.
    pub fn stand(seed: u64) -> Self {
        Self::stand_by(&crate::mechanism(), nominal(), &controller_parameters(), &plant_parameters(), seed)
    }

    /// The same with another robot and its half-step.
    pub fn stand_by(
        mechanism: &Mechanism,
        table: Arc<NominalTable>,
        parameters: &controller::Parameters,
        plant: &plant::PlantParameters,
        seed: u64,
    ) -> Self {
        let start = standing_by(mechanism, table.clone(), parameters);
        let plant = Plant::new(mechanism, plant, &start, PERIOD, seed);
        let controller = Controller::standing(mechanism, table, parameters, Start::default());
        let driver = Driver { controller: controller.expect("the nominal walks"), worker: InlineWorker };
        Self::new(driver, plant)
    }

    /// The controller.
    pub fn controller(&self) -> &Controller {
        &self.driver.controller
    }

    /// One period of both, with a single request of a person.
    pub fn tick(&mut self, request: Option<(&GaitChange, Option<Intent>)>) -> Tick {
        let request = request.map(|(gait, intent)| Request { gait: *gait, intent, ..Request::new(Source::Console) });
        self.tick_with(request.as_ref())
    }

    /// One period of both, with a request of any source.
    pub fn tick_with(&mut self, request: Option<&Request>) -> Tick {
        self.tick_in(request, Plant::step)
    }

    /// The same with the plant moved on by `step`: by another engine, for example.
    pub fn tick_in(
        &mut self,
        request: Option<&Request>,
        step: impl FnOnce(&mut Plant, &Setpoint) -> Measurement,
    ) -> Tick {
        self.waiting.extend(request);
        let step_of_driver = self.driver.step(PERIOD, Some(&self.measurement), |urgent_only| {
            let is_due = |request: &Request| !urgent_only || request.is_urgent();
            let at = self.waiting.iter().position(is_due)?;
            self.waiting.remove(at)
        });
        let tick = step_of_driver.tick;
        self.tick += 1;
        self.measurement = step(&mut self.plant, &tick.setpoint);
        tick
    }

    /// Requests something: the report of the tick that answers, which is this one or, if it has to wait for a support
    /// change, one soon.
    pub fn ask(&mut self, request: GaitChange, intent: Option<Intent>) -> Tick {
        self.ask_for(&Request { gait: request, intent, ..Request::new(Source::Console) })
    }

    /// The same with any request.
    pub fn ask_for(&mut self, request: &Request) -> Tick {
        let mut report = self.tick_with(Some(request));
        for _ in 0..ANSWERED_WITHIN {
            if report.reply.is_some() {
                break;
            }
            report = self.tick(None);
        }
        report
    }

    /// Whether the robot lies, or the controller believes so: `report` is the last tick's.
    pub fn has_fallen(&self, report: &Tick) -> bool {
        report.report.mode == Mode::Fallen || self.plant.truth().has_fallen()
    }

    /// Walks on until a tick is reported of which `reached` is true, for at most `seconds`, or until it falls.
    ///
    /// # Errors
    /// The last report, if it fell or took longer.
    pub fn walk_until(&mut self, seconds: f64, mut reached: impl FnMut(&Tick) -> bool) -> Result<Tick, Box<Tick>> {
        let end = self.time() + seconds;
        loop {
            let report = self.tick(None);
            if self.has_fallen(&report) {
                return Err(Box::new(report));
            } else if reached(&report) {
                return Ok(report);
            } else if self.time() >= end {
                return Err(Box::new(report));
            }
        }
    }

    /// Walks on for `seconds`, or until it falls: the truth at the end.
    pub fn walk(&mut self, seconds: f64) -> Truth {
        for _ in 0..(seconds / PERIOD).round() as u64 {
            let report = self.tick(None);
            let truth = self.plant.truth();
            if truth.has_fallen() || report.report.mode == Mode::Fallen {
                return truth;
            }
        }
        self.plant.truth()
    }

    /// Walked time so far (s).
    pub fn time(&self) -> f64 {
        self.tick as f64 * PERIOD
    }
}
