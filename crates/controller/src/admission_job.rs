//! An admission job: what of a request can be granted, found by simulating the coming half-steps beside the loop. A
//! stop needs none.
//!
//! The controller opens it with a copy of its pattern generator. The driver takes it, evaluates it (at once in
//! lockstep, on another thread in real time) and completes it. That takes milliseconds and allocates nothing.

use interface::{Command, GaitChange, Intent, Objection, Places, Reason, Request, SteadyWalk, Verdict, WalkVelocity};
use pattern::{Departure, Feasibility, FeasibilityCheck, Gait, GaitState, Pace, PatternGenerator};

use crate::limit_objection::objection;
use crate::localization::Localization;
use crate::pattern::goal_of;

/// Half-steps that are simulated with all of the request in effect: one of each foot.
const HALF_STEPS: u64 = 2;
/// Least and most knots that a request is simulated ahead: 2.8 s, in which a walk at nominal speed makes these
/// half-steps, and 10 s.
const KNOTS: std::ops::Range<usize> = 280..1000;
/// Bisections between the command in force and the requested one in search of what can be granted.
const BISECTIONS: usize = 4;
/// Bisections in search of the share of a velocity that is in the configured range, which costs little.
const RANGE_BISECTIONS: usize = 12;
/// A request that would violate a limit this shortly before a support change (s) is evaluated again after it: by then
/// the centre of mass has moved over the next foot.
const LATE: f64 = 0.2;

/// A request under evaluation.
#[derive(Clone, Debug)]
pub struct AdmissionJob {
    wanted: Wanted,
    /// The pace at which the walk changes over to it.
    pace: Pace,
    intent: Option<Intent>,
    pub(crate) check: FeasibilityCheck,
    /// A copy of the controller's generator; once evaluated, how it goes on with what was granted.
    pub(crate) generator: PatternGenerator,
    /// Where the robot was then.
    pub(crate) localization: Localization,
    /// Revision of the controller's generator when it was copied.
    revision: u64,
    /// The copy that is simulated ahead.
    pub(crate) trial: PatternGenerator,
    /// How a walk to a destination sets out.
    pub(crate) departure: Departure,
    decision: Option<Decision>,
    /// The half-step whose end the decision waits for, if it does.
    waits_in: Option<u64>,
}

/// What a request asks of the walk.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "nothing is allocated for a request")]
enum Wanted {
    /// Other gait parameters. Less of it lies between those in force and these.
    Parameters(GaitChange),
    /// A velocity. Less of it is slower, in the same direction and on the same arc.
    Velocity(WalkVelocity),
    /// A walk to places, in the walk frame, at a speed factor. Less of it is slower or by smaller half-steps.
    Destination(Places, Option<f64>),
}

/// What became of a request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Decision {
    /// Granted as requested, in part, or not at all.
    pub verdict: Verdict,
    /// What is in force from then on.
    pub granted: Command,
    /// The half-step at which all of it is in effect.
    pub effect_half_step: u64,
    /// Why it was not granted as requested.
    pub objection: Option<Objection>,
    /// Least predicted ZMP margin (m), if half-steps are predicted.
    pub predicted_margin: Option<f64>,
    /// The place that the objection is about, counted from 1.
    pub place: Option<u32>,
    /// Foreseen time until the robot stands at its destination (s).
    pub arrival: Option<f64>,
    /// The walk of the largest half-steps on the way to way-points.
    pub walk: Option<SteadyWalk>,
}

impl AdmissionJob {
    /// An empty job, to be opened for each request.
    pub(crate) fn new(check: FeasibilityCheck, generator: &PatternGenerator) -> Self {
        Self {
            wanted: Wanted::Parameters(GaitChange::NONE),
            pace: Pace::AtOnce,
            intent: None,
            check,
            generator: generator.clone(),
            revision: generator.revision(),
            trial: generator.clone(),
            localization: Localization::default(),
            departure: Departure { share: 1.0, stops_first: false },
            decision: None,
            waits_in: None,
        }
    }

    /// Opens it for a request.
    pub(crate) fn open(&mut self, generator: &PatternGenerator, localization: &Localization, request: &Request) {
        self.wanted = match (request.velocity, &request.destination) {
            (_, Some(destination)) => Wanted::Destination(localization.places(destination), request.gait.speed),
            (Some(velocity), None) => Wanted::Velocity(velocity),
            (None, None) => Wanted::Parameters(request.gait),
        };
        let walks = request.velocity.is_some() || request.destination.is_some();
        self.intent = request.intent.or(walks.then_some(Intent::Walk));
        (self.decision, self.waits_in) = (None, None);
        self.renew(generator, localization);
    }

    /// Copies the generator as it is now; a decision that is there already is to be applied to that.
    pub(crate) fn renew(&mut self, generator: &PatternGenerator, localization: &Localization) {
        self.generator.clone_from(generator);
        self.localization = *localization;
        self.revision = generator.revision();
    }

    /// Decides what can be granted, unless that is decided, and plans the walk with it. The decision may have to wait
    /// for a support change; then the job stays undecided, to be renewed and evaluated again.
    pub fn evaluate(&mut self) {
        let index = self.generator.half_step().index;
        if self.decision.is_none() && self.waits_in == Some(index) {
            return;
        }
        let Some(decision) = self.decision.or_else(|| self.decide()) else {
            self.waits_in = Some(index);
            return;
        };
        if let Wanted::Destination(places, _) = &self.wanted {
            let begins = index + u64::from(self.generator.gait_state().is_stepping());
            if decision.verdict != Verdict::Refused {
                let sole = self.localization.support_sole;
                self.generator.walk_to(places, &sole, decision.granted.speed, self.departure);
            }
            self.decision = Some(Decision { effect_half_step: begins, ..decision });
            return;
        }
        let granted = self.asked_of(&decision.granted.into());
        let applied = apply(&mut self.generator, &granted, self.intent, self.pace);
        let arrives = index + u64::from(self.generator.gait_state().half_steps_to_goal());
        self.decision = Some(Decision { effect_half_step: applied.effect_half_step.max(arrives), ..decision });
    }

    /// The plan with what was granted, and the decision, once there is one for the generator as it is now.
    pub(crate) fn decided_for(&self, generator: &PatternGenerator) -> Option<(&PatternGenerator, Decision)> {
        self.decision.filter(|_| self.revision == generator.revision()).map(|decision| (&self.generator, decision))
    }

    /// The intent of the request.
    pub(crate) fn intent(&self) -> Option<Intent> {
        self.intent
    }

    /// Whether the request is one to walk to places.
    pub(crate) fn is_to_destination(&self) -> bool {
        matches!(self.wanted, Wanted::Destination(..))
    }

    fn decide(&mut self) -> Option<Decision> {
        let in_force = self.generator.command();
        let velocity = match self.wanted {
            Wanted::Destination(places, speed) => return self.decide_destination(&places, speed),
            Wanted::Velocity(velocity) => Some(velocity),
            Wanted::Parameters(_) => None,
        };
        if velocity.is_some_and(|velocity| !velocity.is_finite()) {
            let objection = Some(Objection { reason: Reason::NotFinite, active_limit: None });
            let unchanged = Decision::unchanged(in_force, self.generator.half_step().index);
            return Some(Decision { verdict: Verdict::Refused, objection, ..unchanged });
        }
        self.pace = if velocity.is_some() { Pace::InStep } else { Pace::AtOnce };
        let out_of_range = velocity.and_then(|velocity| self.range_objection(&velocity));
        let change = match (velocity, self.wanted) {
            (Some(velocity), _) => self.generator.command_at(&self.within_range(&velocity)).into(),
            (None, Wanted::Parameters(change)) => change,
            (None, _) => GaitChange::NONE,
        };
        let (mut requested, mut feasibility) = self.simulate(&change);
        if velocity.is_some() && !self.check.is_ample(&feasibility) {
            // The present half-step ends as planned; the next one begins the change.
            self.pace = Pace::Quick;
            (requested, feasibility) = self.simulate(&change);
        }
        if velocity.is_some() && feasibility.violation.is_some() {
            // What cannot be reached quickly may be reached gradually.
            self.pace = Pace::Gradual;
            (requested, feasibility) = self.simulate(&change);
        }
        let requested = match out_of_range {
            Some(objection) if requested.verdict == Verdict::Accepted => {
                Decision { verdict: Verdict::Limited, objection: Some(objection), ..requested }
            }
            _ => requested,
        };
        if feasibility.violation.is_some() && self.is_late() {
            return None;
        }
        let decided = |decision: Decision, feasibility: &Feasibility| {
            let predicted_margin = Some(feasibility.margin).filter(|margin| margin.is_finite());
            Some(Decision { predicted_margin, ..decision })
        };
        let requested = self.qualified(requested);
        // There is nothing to search for when no limit is violated.
        if requested.verdict == Verdict::Refused || feasibility.violation.is_none() {
            return decided(requested, &feasibility);
        }
        let (mut base, mut unchanged) = (in_force, self.simulate(&in_force.into()).1);
        if unchanged.violation.is_some() && self.generator.gait_state() != GaitState::Walking {
            // What is in force is not walked: it excuses nothing.
            base = Command::NOMINAL;
            unchanged = self.simulate(&base.into()).1;
        }
        if let Some(overload) = unchanged.overload() {
            // No start can be made, whatever the walk after it.
            let unchanged = Decision::unchanged(in_force, self.generator.half_step().index);
            let objection = Some(objection(&overload));
            return Some(Decision { verdict: Verdict::Refused, objection, ..unchanged });
        }
        if feasibility.is_no_worse_than(&unchanged) {
            return decided(requested, &feasibility);
        }
        let (mut best, mut best_share) = (unchanged, 0.0);
        let mut step = 0.5;
        let velocity = velocity.map(|velocity| self.within_range(&velocity));
        let less = |job: &Self, share: f64| match velocity {
            Some(velocity) => job.generator.command_at(&velocity.scaled(share)),
            None => between(&base, &requested.granted, share),
        };
        for _ in 0..BISECTIONS {
            let share = best_share + step;
            let (_, feasibility) = self.simulate(&less(self, share).into());
            if feasibility.is_no_worse_than(&unchanged) {
                (best, best_share) = (feasibility, share);
            }
            step /= 2.0;
        }
        let verdict = if best_share > 0.0 { Verdict::Limited } else { Verdict::Refused };
        let granted = if best_share > 0.0 { less(self, best_share) } else { base };
        let objection = feasibility.violation.as_ref().map(objection).or(requested.objection);
        decided(Decision { verdict, granted, objection, ..requested }, &best)
    }

    /// Why a velocity is outside the configured range of gait parameters, if it is.
    fn range_objection(&self, velocity: &WalkVelocity) -> Option<Objection> {
        self.generator.walk().grant(&self.generator.command_at(velocity).into(), Command::NOMINAL).objection
    }

    /// The largest share of a velocity that is within the configured range.
    fn within_range(&self, velocity: &WalkVelocity) -> WalkVelocity {
        if self.range_objection(velocity).is_none() {
            return *velocity;
        }
        let (mut share, mut step) = (0.0, 0.5);
        for _ in 0..RANGE_BISECTIONS {
            if self.range_objection(&velocity.scaled(share + step)).is_none() {
                share += step;
            }
            step /= 2.0;
        }
        velocity.scaled(share)
    }

    /// Whether a support change is near; never in the first half of a half-step, so that no request waits for ever.
    pub(crate) fn is_late(&self) -> bool {
        let left = 1.0 - self.generator.half_step().progress;
        let late = LATE * self.generator.speed() / self.generator.walk().table().duration;
        self.generator.gait_state().is_stepping() && left < late.min(0.5)
    }

    /// Simulates the coming knots with a change: as the robot will move, and as it will walk with what is in force only
    /// once it does. In a stand gait parameters wait for that, and in place the extension and a high speed do.
    pub(crate) fn simulate(&mut self, change: &GaitChange) -> (Decision, Feasibility) {
        let changes_something = self.wanted != Wanted::Parameters(GaitChange::NONE);
        match self.intended_gait() {
            IntendedGait::Walk => self.simulate_with(change, self.intent),
            IntendedGait::Stand if self.intent.is_none() => self.simulate_with(change, Some(Intent::Walk)),
            IntendedGait::InPlace if changes_something => {
                let walked = self.simulate_with(change, Some(Intent::Walk)).1;
                let (decision, feasibility) = self.simulate_with(change, self.intent);
                (decision, feasibility.and(&walked))
            }
            IntendedGait::Stand | IntendedGait::InPlace => self.simulate_with(change, self.intent),
        }
    }

    /// Simulates the coming knots with a change and an intent, until a full step was made with both.
    fn simulate_with(&mut self, change: &GaitChange, intent: Option<Intent>) -> (Decision, Feasibility) {
        self.trial.clone_from(&self.generator);
        let asked = self.asked_of(change);
        let decision = apply(&mut self.trial, &asked, intent, self.pace);
        let end = decision.effect_half_step + HALF_STEPS;
        let goes_on = |trial: &PatternGenerator, knots: usize| {
            let is_seen = trial.half_step().index >= end || trial.gait_state().is_standing();
            knots < if is_seen { KNOTS.start } else { KNOTS.end }
        };
        (decision, self.check.play(&mut self.trial, goes_on))
    }

    /// A request for nothing but another speed leaves the destination of the walk.
    fn asked_of(&self, change: &GaitChange) -> GaitChange {
        let only_speed = GaitChange { speed: change.speed, ..GaitChange::NONE };
        let leaves = |asked: &GaitChange| GaitChange { speed: None, ..*asked } == GaitChange::NONE;
        let keeps = self.generator.destination().is_some()
            && self.intent.is_none()
            && matches!(&self.wanted, Wanted::Parameters(asked) if leaves(asked));
        if keeps { only_speed } else { *change }
    }

    /// What the robot does once the intent is in effect.
    fn intended_gait(&self) -> IntendedGait {
        match (self.intent, self.generator.gait_state()) {
            (Some(Intent::Walk), _) | (None, GaitState::Walking) => IntendedGait::Walk,
            (Some(Intent::InPlace), _) | (None, GaitState::InPlace { .. }) => IntendedGait::InPlace,
            _ => IntendedGait::Stand,
        }
    }

    /// Tells that part of what was asked for is not walked in place.
    fn qualified(&self, decision: Decision) -> Decision {
        let Wanted::Parameters(GaitChange { speed, extension, .. }) = self.wanted else { return decision };
        let waits = speed.is_some_and(|speed| speed > 1.0) || extension.is_some_and(|extension| extension != 0.0);
        if decision.verdict == Verdict::Accepted && waits && self.intended_gait() == IntendedGait::InPlace {
            let objection = Some(Objection { reason: Reason::InPlace, active_limit: None });
            return Decision { verdict: Verdict::Limited, objection, ..decision };
        }
        decision
    }
}

/// What the robot does once an intent is in effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum IntendedGait {
    Walk,
    InPlace,
    Stand,
}

/// Applies what the configured range admits of a change, and the intent.
///
/// * `pace` – at which the walk changes over
fn apply(generator: &mut PatternGenerator, change: &GaitChange, intent: Option<Intent>, pace: Pace) -> Decision {
    let gait::RangeCheck { verdict, objection, granted, effect_half_step } = generator.admit_at(pace, change);
    if verdict != Verdict::Refused
        && let Some(goal) = intent.and_then(goal_of)
    {
        generator.set_goal(goal);
    }
    Decision {
        verdict,
        granted,
        effect_half_step,
        objection,
        predicted_margin: None,
        place: None,
        arrival: None,
        walk: None,
    }
}

/// A share of the way from one command to another.
fn between(from: &Command, to: &Command, share: f64) -> Command {
    let mix = |from: f64, to: f64| from + (to - from) * share;
    Command {
        turn: mix(from.turn, to.turn),
        speed: mix(from.speed, to.speed),
        extension: mix(from.extension, to.extension),
        sidestep: mix(from.sidestep, to.sidestep),
    }
}
