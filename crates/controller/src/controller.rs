//! The controller: one tick, read from top to bottom.

use std::sync::Arc;

use balance::preview::{Gate, Stance};
use balance::{CentreOfMass, Feedback, Ground, Plan, Sensed, ZmpEstimator};
use dynamics::{Kinematics, Tree};
use gait::{Admission, NominalTable, Request, Start, Verdict, Walk, WalkError};
use model::{Mechanism, Motion, Side};
use nalgebra::Vector2;

use crate::mode::Holding;
use crate::watch::Watch;
use crate::{
    AddedAngles, Answer, Fault, Faults, Guard, Intent, Measurement, Mode, Parameters, Pattern, Refusal, Setpoint,
    TickReport,
};

/// With the measured ZMP so far inside a sole, all of it is on the ground [m].
const FLAT_MARGIN: f64 = 0.005;

/// The state of the controller. Everything is made in [`Controller::new`]; a tick allocates nothing.
#[derive(Clone, Debug)]
pub struct Controller {
    mechanism: Mechanism,
    tree: Tree,
    pattern: Pattern,
    watch: Watch,
    kinematics: Kinematics,
    zmp_estimator: ZmpEstimator,
    ground: Ground,
    plan: Plan,
    feedback: Feedback,
    /// How the robot is turned beyond the plan, about x and y of support coordinates, when last sensed [rad].
    tilt: Vector2<f64>,
    guard: Guard,
    mode: Mode,
    intent: Intent,
    /// The stop of a pattern that cannot stand by itself.
    holding: Option<Holding>,
}

impl Controller {
    /// A controller that is about to begin its first half-step, with everything checked that could go wrong later.
    ///
    /// # Errors
    /// See [`WalkError`].
    pub fn new(
        mechanism: &Mechanism,
        table: Arc<NominalTable>,
        parameters: &Parameters,
        start: Start,
    ) -> Result<Self, WalkError> {
        let walk = Walk::new(table, mechanism, &parameters.gait, start)?;
        let tree = Tree::new(mechanism);
        let mut plan = Plan::new(mechanism, &tree, walk.mirror());
        plan.update(&tree, walk.mirror(), &walk.motion(), false);
        let guard = Guard::new(mechanism, &walk.physical_motion().angles);
        let pattern = Pattern::new(mechanism, walk, parameters.compensation);
        Ok(Self {
            watch: Watch::new(mechanism, parameters.watch),
            kinematics: Kinematics::default(),
            zmp_estimator: ZmpEstimator::new(mechanism, parameters.balance.zmp),
            ground: Ground { zmp: None, margin: f64::NEG_INFINITY, loads: [0.0; 2], bears: [false; 2] },
            feedback: Feedback::new(mechanism, parameters.balance.feedback),
            tilt: Vector2::zeros(),
            guard,
            mode: Mode::Walking,
            intent: Intent::Walk,
            holding: None,
            mechanism: mechanism.clone(),
            tree,
            pattern,
            plan,
        })
    }

    /// One period.
    ///
    /// * `dt` – its length [s]
    /// * `measurement` – the newest one, if a new one came since the last tick
    /// * `request` – at most one per tick, with what the operator intends
    pub fn tick(
        &mut self,
        dt: f64,
        measurement: Option<&Measurement>,
        request: Option<(&Request, Option<Intent>)>,
    ) -> TickReport {
        let mut faults = Faults::default();
        let answer = request.map(|(request, intent)| self.answer(request, intent));

        // Where are we?
        let centre_of_mass = self.estimate(measurement, dt, &mut faults);

        // What does balance ask for?
        let is_planned = self.mode != Mode::Fallen && self.holding.is_none();
        if !is_planned {
            self.feedback.release();
        }
        let known = centre_of_mass.filter(|_| is_planned);
        let on_both_feet = self.pattern.weight_on_bearing() < 1.0;
        self.feedback.update(&self.plan.centre_of_mass, known.as_ref(), self.tilt, self.plan.zmp, on_both_feet, dt);

        self.pattern.sense_tilt(if known.is_some() && !on_both_feet { self.tilt } else { Vector2::zeros() });
        if known.is_some() {
            self.pattern.catch(|growth| self.feedback.excess(growth));
        }

        // What does the walk ask for?
        let support = self.pattern.half_step().support;
        let asked = self.advance(dt);
        // What was sensed before a swap is told from the other foot than the rest of the report.
        let is_same_foot = self.pattern.half_step().support == support;
        if self.pattern.is_out_of_reach() {
            faults.insert(Fault::OutOfReach);
        }

        // What may the joints be given?
        let setpoint = self.limit(&asked, dt, &mut faults);

        TickReport {
            setpoint,
            mode: self.mode,
            half_step: self.pattern.half_step(),
            command: self.pattern.command(),
            speed: self.pattern.speed(),
            zmp_in_support: self.ground.zmp.filter(|_| is_same_foot),
            zmp_planned: self.plan.zmp,
            margin: self.ground.margin,
            lean: self.feedback.lean,
            added: self.added(&asked),
            com_planned: self.plan.centre_of_mass,
            com_sensed: centre_of_mass.filter(|_| is_same_foot),
            faults,
            answer,
        }
    }

    /// Absorbs a measurement; gives the centre of mass as sensed, if something good was sensed.
    fn estimate(&mut self, measurement: Option<&Measurement>, dt: f64, faults: &mut Faults) -> Option<CentreOfMass> {
        let good = self.watch.update(measurement, dt, faults);
        if self.watch.is_stale() && self.intent != Intent::Hold {
            self.intend(Intent::Hold);
        }
        let (measurement, up_in_trunk) = good?;
        if self.watch.has_fallen() {
            faults.insert(Fault::Fallen);
            self.mode = Mode::Fallen;
        }

        let sensed = Sensed::from_support(
            self.pattern.half_step().support,
            self.pattern.mirror(),
            &measurement.angles,
            &measurement.rates,
            &measurement.feet,
            up_in_trunk,
            measurement.angular_rate,
        );
        self.kinematics.stand(&self.tree, &sensed.angles);
        self.ground = self.zmp_estimator.update(&sensed, &self.kinematics, &self.mechanism, dt);
        if self.ground.zmp.is_none() {
            faults.insert(Fault::InTheAir);
            self.feedback.release();
            return None;
        }
        // A sole that bears alone, and not on an edge, lies flat: it leans as the floor does.
        if self.ground.margin > FLAT_MARGIN && !self.ground.bears[1] {
            self.pattern.sense_vertical(sensed.up_over_sole(&self.kinematics).xy(), dt);
        }
        self.tilt = self.plan.tilt(&sensed.up_in_trunk, self.pattern.vertical_now());
        Some(CentreOfMass::sensed(&self.tree, &self.kinematics, &sensed))
    }

    /// Moves on by a period and gives what the mode asks for, in support coordinates, feedback included.
    fn advance(&mut self, dt: f64) -> Motion {
        let motion = match (self.mode, &mut self.holding) {
            (Mode::Fallen, _) => return Motion::default(),
            (_, Some(holding)) => holding.advance(&self.tree, dt),
            (_, None) => {
                if self.pattern.advance(dt) {
                    self.swap();
                }
                self.pattern.motion()
            }
        };
        self.mode = match self.pattern.gate() {
            _ if self.holding.is_some() => Mode::Holding,
            Gate::Opening(_) => Mode::Starting,
            _ if self.pattern.weight_on_bearing() < 1.0 => Mode::Holding,
            _ => Mode::Walking,
        };
        let on_both_feet = self.pattern.weight_on_bearing() < 1.0;
        self.plan.update(&self.tree, self.pattern.mirror(), &motion, on_both_feet);
        motion + *self.feedback.offsets()
    }

    /// A new half-step has begun, told from the other foot.
    fn swap(&mut self) {
        self.feedback.swap(self.pattern.mirror());
        self.zmp_estimator.swap();
        if self.intent != Intent::Walk && !self.pattern.can_stand() {
            let pendulum_rate = self.plan.centre_of_mass.pendulum_rate();
            self.holding = Some(Holding::begin(&self.tree, &self.pattern.motion(), pendulum_rate));
        }
    }

    /// Goes on or stops at the next swap.
    fn intend(&mut self, intent: Intent) {
        self.intent = intent;
        match intent {
            Intent::Walk => self.pattern.start(),
            Intent::Stop => self.pattern.stop(Stance::Parallel),
            Intent::Hold => self.pattern.stop(Stance::Stride),
        }
    }

    /// Brings what is asked back to physical joints and through the guard.
    fn limit(&mut self, asked: &Motion, dt: f64, faults: &mut Faults) -> Setpoint {
        if self.mode == Mode::Fallen {
            return self.guard.hold();
        }
        match self.pattern.half_step().support {
            Side::Right => self.guard.limit(asked, &self.plan.torques, dt, faults),
            Side::Left => {
                let mirror = self.pattern.mirror();
                self.guard.limit(&asked.mirrored(mirror), &mirror.apply(&self.plan.torques), dt, faults)
            }
        }
    }

    /// What the plan adds to the plain sum of the modifications. The walk is known at the newest knot, a little ahead of
    /// now: just before a swap only as told from the other foot.
    fn added(&self, asked: &Motion) -> Option<AddedAngles> {
        let (walk, now) = match &self.pattern {
            Pattern::Plain(walk) => (walk.as_ref(), walk.half_step()),
            Pattern::Preview(preview) => (preview.walk(), preview.half_step()),
        };
        let is_known = self.mode != Mode::Fallen && self.holding.is_none() && walk.half_step().index == now.index;
        let planned = asked.angles - self.feedback.offsets().angles;
        is_known.then(|| AddedAngles::between(&self.mechanism, &walk.motion_at(now.progress).angles, &planned))
    }

    /// Answers a request: the walk admits what changes it, the mode says whether there is a walk to change.
    fn answer(&mut self, request: &Request, intent: Option<Intent>) -> Answer {
        let refusal = match (self.mode, intent) {
            (Mode::Fallen, _) => Some(Refusal::Fallen),
            (_, None | Some(Intent::Walk)) if self.holding.is_some() => Some(Refusal::Standing),
            _ => None,
        };
        if refusal.is_some() {
            let half_step = self.pattern.half_step().index;
            let admission = Admission {
                verdict: Verdict::Refused,
                reasons: [None; 3],
                granted: self.pattern.command(),
                effect_half_step: half_step,
            };
            return Answer { admission, intent: self.intent, refusal };
        }
        let mut admission = self.pattern.admit(request);
        if admission.verdict != Verdict::Refused
            && let Some(intent) = intent
        {
            self.intend(intent);
            let stands = self.pattern.half_step().index + u64::from(self.pattern.gate().swaps_to_stand());
            admission.effect_half_step = admission.effect_half_step.max(stands);
        }
        Answer { admission, intent: self.intent, refusal }
    }
}
