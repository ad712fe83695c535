//! An inquiry: what can be granted of a request, found out beside the loop by playing the coming half-steps ahead.
//!
//! The controller opens it with a copy of its preview; whoever drives the loop takes it, settles it (at once in lockstep, on
//! another thread in real time) and gives it back. It takes milliseconds and allocates nothing.

use balance::Preview;
use balance::preview::{Forecast, Forecaster, Goal, Limit, Stance, Strain};
use gait::{Admission, Command, Request, Verdict};

use crate::Intent;

/// Knots that a request is played ahead: 2.8 s, in which turn, extension and speed have all come into effect.
const KNOTS: usize = 280;
/// Halvings of the way from what is in force to what is asked, in search of what can be granted.
const HALVINGS: usize = 4;
/// What breaks a limit if it begins so shortly before a swap [s] is looked into again after it: the centre of mass has had its
/// way to the next foot by then.
const LATE: f64 = 0.2;
/// By how much what is granted may have less margin than walking on as it is, where that breaks a limit itself [m].
const NO_WORSE: f64 = 0.002;

/// A request that is being looked into.
#[derive(Clone, Debug)]
pub struct Inquiry {
    request: Request,
    intent: Option<Intent>,
    forecaster: Forecaster,
    /// A copy of the controller's; once settled as it goes on with what was granted.
    preview: Preview,
    /// Of the controller's when it was copied.
    stamp: u64,
    trial: Preview,
    ruling: Option<Ruling>,
}

/// What became of a request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ruling {
    /// What is granted and when it takes effect.
    pub admission: Admission,
    /// The limit that kept it from being granted as asked.
    pub strain: Option<Strain>,
    /// Least margin that is foreseen [m], if half-steps are.
    pub margin: Option<f64>,
}

impl Inquiry {
    /// Nothing asked yet.
    pub fn new(forecaster: Forecaster, preview: &Preview) -> Self {
        Self {
            request: Request::default(),
            intent: None,
            forecaster,
            preview: preview.clone(),
            stamp: preview.stamp(),
            trial: preview.clone(),
            ruling: None,
        }
    }

    /// Opens it for a request.
    pub(crate) fn open(&mut self, preview: &Preview, request: &Request, intent: Option<Intent>) {
        (self.request, self.intent, self.ruling) = (*request, intent, None);
        self.renew(preview);
    }

    /// Copies the preview as it is now; a ruling there is has to be applied to that.
    pub(crate) fn renew(&mut self, preview: &Preview) {
        self.preview.clone_from(preview);
        self.stamp = preview.stamp();
    }

    /// Finds out what can be granted, unless that is known, and what the walk will be then. It may have to wait for a swap;
    /// then there is no ruling yet.
    pub fn settle(&mut self) {
        let Some(ruling) = self.ruling.or_else(|| self.rule()) else { return };
        let index = self.preview.half_step().index;
        let admission = apply(&mut self.preview, &ruling.admission.granted.into(), self.intent);
        let stands = index + u64::from(self.preview.gate().swaps_to_goal());
        let effect_half_step = admission.effect_half_step.max(stands);
        self.ruling = Some(Ruling { admission: Admission { effect_half_step, ..ruling.admission }, ..ruling });
    }

    /// What the walk will be, and what is to be answered, once it is settled for a preview that is still the same.
    pub(crate) fn settled_for(&self, preview: &Preview) -> Option<(&Preview, Ruling, Option<Intent>)> {
        self.ruling.filter(|_| self.stamp == preview.stamp()).map(|ruling| (&self.preview, ruling, self.intent))
    }

    /// What is intended by whoever asked.
    pub(crate) fn intent(&self) -> Option<Intent> {
        self.intent
    }

    fn rule(&mut self) -> Option<Ruling> {
        let in_force = self.preview.command();
        let request = self.request;
        let (admission, asked) = self.foresee(&request);
        let foreseen = |forecast: &Forecast| Some(forecast.margin).filter(|margin| margin.is_finite());
        if asked.strain.is_some() && self.is_late() {
            return None;
        }
        // Coming to a stand is granted whatever it costs; and there is nothing to find in what breaks no limit.
        let is_stop = matches!(self.intent, Some(Intent::Stop | Intent::Hold));
        if admission.verdict == Verdict::Refused || asked.strain.is_none() || is_stop {
            return Some(Ruling { admission, strain: None, margin: foreseen(&asked) });
        }
        let (_, unchanged) = self.foresee(&in_force.into());
        let is_fine = |forecast: &Forecast| match (forecast.strain, unchanged.strain) {
            (None, _) => true,
            (Some(_), None) => false,
            (Some(strain), Some(before)) => {
                let both_margins = strain.limit == Limit::Margin && before.limit == Limit::Margin;
                both_margins && forecast.margin > unchanged.margin - NO_WORSE
                    || strain.limit == before.limit && !both_margins
            }
        };
        if is_fine(&asked) {
            return Some(Ruling { admission, strain: None, margin: foreseen(&asked) });
        }
        let (mut best, mut best_share) = (unchanged, 0.0);
        let mut step = 0.5;
        for _ in 0..HALVINGS {
            let share = best_share + step;
            let (_, forecast) = self.foresee(&between(&in_force, &admission.granted, share).into());
            if is_fine(&forecast) {
                (best, best_share) = (forecast, share);
            }
            step /= 2.0;
        }
        let verdict = if best_share > 0.0 { Verdict::Limited } else { Verdict::Refused };
        let granted = between(&in_force, &admission.granted, best_share);
        let admission = Admission { verdict, granted, ..admission };
        Some(Ruling { admission, strain: asked.strain, margin: foreseen(&best) })
    }

    /// Whether a half-step that is walked is about to end; never in its first half, so that nothing waits for ever.
    fn is_late(&self) -> bool {
        let left = 1.0 - self.preview.half_step().progress;
        let late = LATE * self.preview.speed() / self.preview.walk().table().duration;
        self.preview.gate().walks() && left < late.min(0.5)
    }

    /// Plays on with a request.
    fn foresee(&mut self, request: &Request) -> (Admission, Forecast) {
        self.trial.clone_from(&self.preview);
        let admission = apply(&mut self.trial, request, self.intent);
        (admission, self.forecaster.play(&mut self.trial, KNOTS))
    }
}

fn apply(preview: &mut Preview, request: &Request, intent: Option<Intent>) -> Admission {
    let admission = preview.admit(request);
    if admission.verdict != Verdict::Refused {
        match intent {
            Some(Intent::Walk) => preview.aim(Goal::Walk),
            Some(Intent::InPlace) => preview.aim(Goal::InPlace),
            Some(Intent::Stop) => preview.aim(Goal::Stand(Stance::Parallel)),
            Some(Intent::Hold) => preview.aim(Goal::Stand(Stance::Stride)),
            Some(Intent::Reset) | None => {}
        }
    }
    admission
}

/// A share of the way from one command to another.
fn between(from: &Command, to: &Command, share: f64) -> Command {
    let mix = |from: f64, to: f64| from + (to - from) * share;
    Command {
        turn: mix(from.turn, to.turn),
        speed: mix(from.speed, to.speed),
        extension: mix(from.extension, to.extension),
    }
}
