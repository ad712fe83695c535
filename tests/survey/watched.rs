//! A walk that is watched: how near it came to falling, or when and how it fell.

use std::fmt;

use controller::Tick;
use halfstep_tests::walking::Walking;
use interface::{Command, GaitChange, Intent, Measurement, Mode, Request, Setpoint, Source};
use plant::Plant;

use crate::asked;

/// Between support changes: at a support change the ZMP goes from foot to foot.
pub(crate) const BETWEEN_SWAPS: std::ops::Range<f64> = 0.1..0.9;

/// Controller and plant, and what was seen of them.
pub(crate) struct Watched {
    /// They walk here.
    pub walking: Walking,
    /// The last tick's.
    pub report: Tick,
    /// Least measured margin between support changes while walking (m).
    pub least_margin: f64,
    /// Largest feedback angle of the support ankle (rad).
    pub largest_lean: f64,
    /// How it ended, if it did.
    pub fall: Option<Fall>,
}

/// A fall.
#[derive(Clone, Debug)]
pub(crate) struct Fall {
    /// Since the beginning (s).
    pub time: f64,
    /// In which half-step.
    pub half_step: u64,
    /// By which command.
    pub command: Command,
    /// What the controller believed.
    pub mode: Mode,
}

impl Watched {
    /// Watches from now on.
    pub(crate) fn new(walking: Walking) -> Self {
        Self::begin_in(walking, Plant::step)
    }

    /// The same with the plant moved on by `step`: by another engine, for example.
    pub(crate) fn begin_in(mut walking: Walking, step: impl FnOnce(&mut Plant, &Setpoint) -> Measurement) -> Self {
        let report = walking.tick_in(None, step);
        Self { walking, report, least_margin: f64::INFINITY, largest_lean: 0.0, fall: None }
    }

    /// Forgets how near it came to falling until now.
    pub(crate) fn begin_anew(&mut self) {
        self.least_margin = f64::INFINITY;
        self.largest_lean = 0.0;
    }

    /// One period, unless it has fallen.
    pub(crate) fn tick(&mut self, request: Option<&GaitChange>) {
        self.tick_in(request, Plant::step);
    }

    /// The same with the plant moved on by `step`: by another engine, for example.
    pub(crate) fn tick_in(
        &mut self,
        request: Option<&GaitChange>,
        step: impl FnOnce(&mut Plant, &Setpoint) -> Measurement,
    ) {
        if self.fall.is_some() {
            return;
        }
        let asked =
            request.map(|gait| Request { gait: *gait, intent: Some(Intent::Walk), ..Request::new(Source::Console) });
        let report = self.walking.tick_in(asked.as_ref(), step);
        self.report = report;
        if self.walking.has_fallen(&report) {
            self.fall = Some(Fall {
                time: self.walking.time(),
                half_step: report.report.half_step.index,
                command: report.command,
                mode: report.report.mode,
            });
        } else if report.report.mode == Mode::Walking && BETWEEN_SWAPS.contains(&report.report.half_step.progress) {
            self.least_margin = self.least_margin.min(report.report.margin.unwrap_or(f64::NEG_INFINITY));
            self.largest_lean = self.largest_lean.max(report.report.lean.amax());
        }
    }

    /// Walks on for so many half-steps, or until it falls.
    pub(crate) fn walk_half_steps(&mut self, half_steps: u64) {
        let end = self.report.report.half_step.index + half_steps;
        // A walk that stands still does not end by itself.
        let patience = self.walking.time() + 5.0 * half_steps as f64;
        while self.fall.is_none() && self.report.report.half_step.index < end && self.walking.time() < patience {
            self.tick(None);
        }
    }

    /// Walks on until a time since the beginning, or until it falls.
    ///
    /// * `request` – made in the first period
    /// * `step` – moves the plant on
    pub(crate) fn walk_until(
        &mut self,
        seconds: f64,
        mut request: Option<GaitChange>,
        mut step: impl FnMut(&mut Plant, &Setpoint) -> Measurement,
    ) {
        while self.fall.is_none() && self.walking.time() < seconds {
            self.tick_in(request.take().as_ref(), &mut step);
        }
    }
}

impl fmt::Display for Fall {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Fall { time, half_step, command, mode } = self;
        write!(f, "fell at {time:.2} s in half-step {half_step}, {mode:?} by {}", asked::text(command))
    }
}
