//! Controller and plant walking together in one process, in lockstep.

use std::collections::VecDeque;
use std::sync::Arc;

use controller::{Asked, Controller, Intent, Lasting, Measurement, Mode, Source, TickReport};
use gait::{NominalTable, Request, Start, Walk};
use model::Mechanism;
use plant::{Plant, Setpoint, Truth};

use crate::repository;

/// Control period of all walks [s].
pub const PERIOD: f64 = 1e-3;

/// Requests that can wait without an allocation.
const WAITING: usize = 16;

/// No answer takes so long [ticks].
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

/// `config/plant.toml`.
pub fn plant_parameters() -> plant::Parameters {
    plant::Parameters::load(repository().join("config/plant.toml")).expect("the committed file loads")
}

/// A controller and a plant that walk together. A clone walks on by itself, to the same bits.
#[derive(Clone, Debug)]
pub struct Walking {
    /// The one.
    pub controller: Controller,
    /// The other.
    pub plant: Plant,
    measured: Measurement,
    tick: u64,
    /// Wait until those before are answered.
    waiting: VecDeque<Asked>,
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
        plant: &plant::Parameters,
        seed: u64,
    ) -> Self {
        Self::begin_by(mechanism, nominal(), controller, plant, seed)
    }

    /// The same with another half-step.
    pub fn begin_by(
        mechanism: &Mechanism,
        table: Arc<NominalTable>,
        controller: &controller::Parameters,
        plant: &plant::Parameters,
        seed: u64,
    ) -> Self {
        let start = Walk::new(table.clone(), mechanism, &controller.gait, Start::default())
            .expect("the nominal walks")
            .physical_motion();
        let mut plant = Plant::new(mechanism, plant, &start, PERIOD, seed);
        let measured = sensed(&plant.measure());
        let controller = Controller::new(mechanism, table, controller, Start::default()).expect("the nominal walks");
        Self { controller, plant, measured, tick: 0, waiting: VecDeque::with_capacity(WAITING) }
    }

    /// One period of both, with a single request of a person.
    pub fn tick(&mut self, request: Option<(&Request, Option<Intent>)>) -> TickReport {
        let asked = request.map(|(request, intent)| Asked {
            request: *request,
            intent,
            source: Source::Console,
            lasting: Lasting::UntilChanged,
        });
        self.tick_with(asked.as_ref())
    }

    /// One period of both, with what somebody asks.
    pub fn tick_with(&mut self, asked: Option<&Asked>) -> TickReport {
        self.tick_in(asked, Plant::step)
    }

    /// The same with the plant moved on by `step`: by another engine, for example.
    pub fn tick_in(
        &mut self,
        asked: Option<&Asked>,
        step: impl FnOnce(&mut Plant, &Setpoint) -> plant::Measurement,
    ) -> TickReport {
        self.settle();
        self.waiting.extend(asked);
        if self.controller.is_free()
            && let Some(asked) = self.waiting.pop_front()
        {
            self.controller.ask(&asked);
            self.settle();
        }
        let report = self.controller.tick(PERIOD, Some(&self.measured));
        self.tick += 1;
        self.measured = sensed(&step(&mut self.plant, &setpoint(&report)));
        report
    }

    fn settle(&mut self) {
        if let Some(mut inquiry) = self.controller.inquiry() {
            inquiry.settle();
            self.controller.give_back(inquiry);
        }
    }

    /// Requests something: the report of the tick that answers, which is this one or, if it has to wait for a swap, one soon.
    pub fn ask(&mut self, request: Request, intent: Option<Intent>) -> TickReport {
        let mut report = self.tick(Some((&request, intent)));
        for _ in 0..ANSWERED_WITHIN {
            if report.answer.is_some() {
                break;
            }
            report = self.tick(None);
        }
        report
    }

    /// Whether the robot lies, or the controller believes so: `report` is the last tick's.
    pub fn has_fallen(&self, report: &TickReport) -> bool {
        report.mode == Mode::Fallen || self.plant.truth().has_fallen()
    }

    /// Walks on until a tick is reported of which `reached` is true, for at most `seconds`, or until it falls.
    ///
    /// # Errors
    /// The last report, if it fell or took longer.
    pub fn walk_until(
        &mut self,
        seconds: f64,
        mut reached: impl FnMut(&TickReport) -> bool,
    ) -> Result<TickReport, Box<TickReport>> {
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
            if truth.has_fallen() || report.mode == Mode::Fallen {
                return truth;
            }
        }
        self.plant.truth()
    }

    /// Walked time so far [s].
    pub fn time(&self) -> f64 {
        self.tick as f64 * PERIOD
    }
}

fn sensed(measured: &plant::Measurement) -> Measurement {
    Measurement {
        tick: measured.sample,
        angles: measured.angles,
        rates: measured.rates,
        feet: measured.feet,
        orientation: measured.orientation.into_inner(),
        angular_rate: measured.angular_rate,
    }
}

fn setpoint(report: &TickReport) -> Setpoint {
    let controller::Setpoint { angles, rates, feed_forward } = report.setpoint;
    Setpoint { angles, rates, feed_forward }
}
