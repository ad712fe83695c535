//! The driver: the order in which a controller is driven in each control period, written once for loops, replay and
//! tests.
//!
//! A request that changes a planned walk becomes an [`AdmissionJob`](crate::AdmissionJob), which takes milliseconds. An
//! [`AdmissionWorker`] evaluates it: at once within the period ([`InlineWorker`]), on another thread, or when a
//! recording says. The order of jobs and requests within a period decides the bits of what follows, so a recording
//! keeps the [`AdmissionTiming`].

use interface::{Measurement, Request};

use crate::{Controller, Tick};

/// When, in a control period, a completed admission job came back to the controller. The numbers are those of
/// recordings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum AdmissionTiming {
    /// No job came back.
    #[default]
    None = 0,
    /// Before the period's request was submitted.
    BeforeRequest = 1,
    /// After the period's request was submitted.
    AfterRequest = 2,
}

impl AdmissionTiming {
    /// The timing of a recorded number; unknown numbers are those of no job.
    pub const fn from_code(code: u32) -> Self {
        match code {
            1 => Self::BeforeRequest,
            2 => Self::AfterRequest,
            _ => Self::None,
        }
    }
}

/// Evaluates admission jobs.
pub trait AdmissionWorker {
    /// Takes the controller's job, if it has one, and completes those that are evaluated; returns whether one came back
    /// to the controller. Called once or twice per period, at the `point` that a completed job will be recorded with.
    fn serve(&mut self, controller: &mut Controller, point: AdmissionTiming) -> bool;
}

/// Evaluates each job at once: a run depends on its inputs only.
#[derive(Clone, Copy, Debug, Default)]
pub struct InlineWorker;

/// A controller with the worker that evaluates its admission jobs.
#[derive(Clone, Debug)]
pub struct Driver<W> {
    /// The controller.
    pub controller: Controller,
    /// Evaluates its admission jobs.
    pub worker: W,
}

/// A control period of a driven controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// What the controller returned.
    pub tick: Tick,
    /// The request that was submitted in this period, if any.
    pub submitted: Option<Request>,
    /// When a completed admission job came back.
    pub admission: AdmissionTiming,
}

impl<W: AdmissionWorker> Driver<W> {
    /// One control period.
    ///
    /// * `dt` – its length (s)
    /// * `measurement` – the newest one, if there is one
    /// * `next_request` – gives the request that is due, if any; called only if the controller can take one, with
    ///   whether only an [urgent](Request::is_urgent) one can be taken
    pub fn step(
        &mut self,
        dt: f64,
        measurement: Option<&Measurement>,
        next_request: impl FnOnce(bool) -> Option<Request>,
    ) -> Step {
        let mut admission = AdmissionTiming::None;
        if self.worker.serve(&mut self.controller, AdmissionTiming::BeforeRequest) {
            admission = AdmissionTiming::BeforeRequest;
        }
        let urgent_only = !self.controller.accepts_request();
        let submitted = if self.controller.accepts_urgent_request() { next_request(urgent_only) } else { None };
        if let Some(request) = &submitted {
            self.controller.submit(request);
            // A request that was replied to at once leaves no room for the reply of a job.
            if self.controller.accepts_urgent_request()
                && self.worker.serve(&mut self.controller, AdmissionTiming::AfterRequest)
            {
                admission = AdmissionTiming::AfterRequest;
            }
        }
        let tick = self.controller.tick(dt, measurement);
        Step { tick, submitted, admission }
    }
}

impl AdmissionWorker for InlineWorker {
    fn serve(&mut self, controller: &mut Controller, _: AdmissionTiming) -> bool {
        let Some(mut job) = controller.take_job() else { return false };
        job.evaluate();
        controller.complete(job);
        true
    }
}
