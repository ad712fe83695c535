//! The controller: one tick, read from top to bottom. Requests come by `requests.rs`.

use std::sync::Arc;

use balance::preview::{Forecaster, Gate, Stance};
use balance::{Balance, CentreOfMass, Feedback, Ground, Landing, Plan, Preview, Sensed, ZmpEstimator};
use dynamics::{Kinematics, Tree};
use gait::{NominalTable, Start, Walk, WalkError};
use model::{Mechanism, Motion, Side};
use nalgebra::Vector2;

use crate::mode::{Holding, Rising};
use crate::watch::Watch;
use crate::{
    AddedAngles, Answer, Desk, Fault, Faults, Guard, Inquiry, Intent, Measurement, Mode, Parameters, Pattern, Setpoint,
    Sources, TickReport,
};

/// With the measured ZMP so far inside a sole, all of it is on the ground [m].
const FLAT_MARGIN: f64 = 0.005;
/// How long before and after a swap the weight may go from foot to foot [s].
const SWAP: f64 = 0.03;
/// A walk that is slower counts as this fast [-].
const SPEED_MIN: f64 = 0.1;

/// The state of the controller. Everything is made in [`Controller::new`]; a tick allocates nothing.
#[derive(Clone, Debug)]
pub struct Controller {
    mechanism: Mechanism,
    tree: Tree,
    pub(crate) pattern: Pattern,
    /// The stand to get back to after a fall.
    pub(crate) rest: Box<Preview>,
    watch: Watch,
    kinematics: Kinematics,
    zmp_estimator: ZmpEstimator,
    ground: Ground,
    plan: Plan,
    feedback: Feedback,
    landing: Landing,
    /// How the robot is turned beyond the plan, about x and y of support coordinates, when last sensed [rad].
    tilt: Vector2<f64>,
    pub(crate) guard: Guard,
    /// What is intended.
    pub(crate) intent: Intent,
    /// What keeps the robot from going on until a reset.
    pub(crate) latched: Option<Fault>,
    /// The stop of a pattern that cannot stand by itself.
    pub(crate) holding: Option<Holding>,
    /// The way back to a stand.
    pub(crate) rising: Option<Rising>,
    pub(crate) sources: Sources,
    pub(crate) desk: Desk,
    /// Waits for the tick's report.
    pub(crate) answer: Option<Answer>,
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
        Ok(Self::with_pattern(
            mechanism,
            parameters,
            &walk,
            Pattern::new(mechanism, walk.clone(), parameters.compensation),
        ))
    }

    /// A controller of a robot that stands with its feet side by side and walks when asked to. Needs the preview.
    ///
    /// # Errors
    /// See [`WalkError`].
    pub fn standing(
        mechanism: &Mechanism,
        table: Arc<NominalTable>,
        parameters: &Parameters,
        start: Start,
    ) -> Result<Self, WalkError> {
        let walk = Walk::new(table, mechanism, &parameters.gait, start)?;
        let preview = Box::new(Preview::standing(mechanism, walk.clone()));
        let controller = Self::with_pattern(mechanism, parameters, &walk, Pattern::Preview(preview));
        Ok(Self { intent: Intent::Stop, ..controller })
    }

    fn with_pattern(mechanism: &Mechanism, parameters: &Parameters, walk: &Walk, pattern: Pattern) -> Self {
        let tree = Tree::new(mechanism);
        let mut plan = Plan::new(mechanism, &tree, walk.mirror());
        plan.update(&tree, walk.mirror(), &pattern.motion(), pattern.weight_on_bearing() < 1.0);
        let first = match pattern.half_step().support {
            Side::Right => pattern.motion().angles,
            Side::Left => walk.mirror().apply(&pattern.motion().angles),
        };
        let rest = Box::new(Preview::standing(mechanism, walk.clone()));
        let forecaster = Forecaster::new(mechanism, plan.clone(), parameters.forecast);
        Self {
            watch: Watch::new(mechanism, parameters.watch),
            kinematics: Kinematics::default(),
            zmp_estimator: ZmpEstimator::new(mechanism, parameters.balance.zmp),
            ground: Ground { zmp: None, margin: f64::NEG_INFINITY, loads: [0.0; 2], bears: [false; 2] },
            feedback: Feedback::new(mechanism, parameters.balance.feedback),
            landing: Landing::new(mechanism, parameters.balance.landing),
            tilt: Vector2::zeros(),
            guard: Guard::new(mechanism, &first),
            desk: Desk::Free(Box::new(Inquiry::new(forecaster, &rest))),
            rest,
            intent: Intent::Walk,
            latched: None,
            holding: None,
            rising: None,
            sources: Sources::new(parameters.sources),
            answer: None,
            mechanism: mechanism.clone(),
            tree,
            pattern,
            plan,
        }
    }

    /// One period.
    ///
    /// * `dt` – its length [s]
    /// * `measurement` – the newest one, if a new one came since the last tick
    pub fn tick(&mut self, dt: f64, measurement: Option<&Measurement>) -> TickReport {
        let mut faults = Faults::default();

        // Is anybody there?
        if self.sources.advance(dt).is_some() && self.is_on_its_way() {
            self.stop(Stance::Parallel);
        }

        // Where are we?
        let centre_of_mass = self.estimate(measurement, dt, &mut faults);

        // What does balance ask for?
        let is_planned = self.is_planned();
        if !is_planned {
            self.feedback.release();
        }
        let known = centre_of_mass.filter(|_| is_planned);
        let on_both_feet = self.pattern.weight_on_bearing() < 1.0;
        let zmp = self.ground.zmp.filter(|_| self.ground.bears == [true, false] && !self.is_at_swap());
        let sensed = known.map(|centre_of_mass| Balance { centre_of_mass, tilt: self.tilt, zmp });
        self.feedback.update(&self.plan.balance(), sensed.as_ref(), on_both_feet, dt);

        // On both feet the weight goes to and fro as the robot comes to rest.
        let yields = !on_both_feet && !self.is_at_swap() && !self.feedback.is_in_trouble();
        let loads = known.filter(|_| yields).map(|_| self.ground.loads);
        self.landing.update(loads, dt);
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
        if faults.contains(Fault::WalkNotFinite) {
            self.latch(Fault::WalkNotFinite);
        }

        TickReport {
            setpoint,
            mode: self.mode(),
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
            answer: self.answer.take(),
        }
    }

    /// What the controller is doing.
    pub fn mode(&self) -> Mode {
        let standing = |stance| match (self.latched, stance) {
            (Some(_), _) => Mode::Faulted,
            (None, Stance::Parallel) => Mode::Standing,
            (None, Stance::Stride) => Mode::Holding,
        };
        match self.pattern.gate() {
            _ if self.latched == Some(Fault::Fallen) => Mode::Fallen,
            _ if self.rising.is_some() => Mode::Starting,
            _ if self.holding.is_some() => standing(Stance::Stride),
            Gate::Closed(stance) if self.pattern.weight_on_bearing() < 1.0 => standing(stance),
            Gate::Closed(_) | Gate::Closing { .. } => Mode::Stopping,
            _ if self.pattern.weight_on_bearing() < 1.0 => Mode::Starting,
            Gate::Open if !self.is_on_its_way() && !self.pattern.can_stand() => Mode::Stopping,
            Gate::Open | Gate::Opening { .. } => Mode::Walking,
            Gate::InPlace { .. } => Mode::InPlace,
        }
    }

    /// Whether the newest good measurement is of now and tells of a robot on its feet.
    pub(crate) fn is_well(&self) -> bool {
        self.watch.is_upright() && !self.watch.is_stale()
    }

    /// Whether the weight goes from foot to foot just now, as it should.
    fn is_at_swap(&self) -> bool {
        let period = self.pattern.duration() / self.pattern.speed().max(SPEED_MIN);
        let progress = self.pattern.half_step().progress;
        progress.min(1.0 - progress) * period < SWAP
    }

    /// Whether half-steps are intended.
    fn is_on_its_way(&self) -> bool {
        matches!(self.intent, Intent::Walk | Intent::InPlace)
    }

    /// Whether the walk plans what the joints do.
    fn is_planned(&self) -> bool {
        self.latched != Some(Fault::Fallen) && self.holding.is_none() && self.rising.is_none()
    }

    /// Keeps a fault until a reset; what was asked before is forgotten.
    fn latch(&mut self, fault: Fault) {
        if self.latched != Some(Fault::Fallen) {
            self.latched = Some(fault);
            if fault != Fault::Fallen && self.is_on_its_way() {
                self.stop(Stance::Stride);
            }
        }
    }

    /// Absorbs a measurement; gives the centre of mass as sensed, if something good was sensed.
    fn estimate(&mut self, measurement: Option<&Measurement>, dt: f64, faults: &mut Faults) -> Option<CentreOfMass> {
        let good = self.watch.update(measurement, dt, faults);
        if self.watch.is_stale() && self.latched.is_none() {
            self.latch(Fault::MeasurementStale);
        }
        let (measurement, up_in_trunk) = good?;
        if self.watch.has_fallen() {
            faults.insert(Fault::Fallen);
            self.latch(Fault::Fallen);
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
        if self.latched == Some(Fault::Fallen) {
            return Motion::default();
        }
        if let Some(rising) = &mut self.rising {
            match rising.advance(dt) {
                Some(motion) => return self.to_support(&motion),
                None => self.rising = None,
            }
        }
        let motion = if let Some(holding) = &mut self.holding {
            holding.advance(&self.tree, dt)
        } else {
            if self.pattern.advance(dt) {
                self.swap();
            }
            self.pattern.motion()
        };
        let on_both_feet = self.pattern.weight_on_bearing() < 1.0;
        self.plan.update(&self.tree, self.pattern.mirror(), &motion, on_both_feet);
        self.landing.advance(&self.tree, self.plan.kinematics(), &motion.angles, dt);
        motion + *self.feedback.offsets() + *self.landing.offsets()
    }

    /// A motion of physical joints as seen from the bearing foot.
    fn to_support(&self, physical: &Motion) -> Motion {
        match self.pattern.half_step().support {
            Side::Right => *physical,
            Side::Left => physical.mirrored(self.pattern.mirror()),
        }
    }

    /// A new half-step has begun, told from the other foot.
    fn swap(&mut self) {
        self.feedback.swap(self.pattern.mirror());
        self.landing.swap(self.pattern.mirror());
        self.zmp_estimator.swap();
        if !self.is_on_its_way() && !self.pattern.can_stand() {
            let pendulum_rate = self.plan.centre_of_mass.pendulum_rate();
            self.holding = Some(Holding::begin(&self.tree, &self.pattern.motion(), pendulum_rate));
        }
    }

    /// Brings what is asked back to physical joints and through the guard.
    fn limit(&mut self, asked: &Motion, dt: f64, faults: &mut Faults) -> Setpoint {
        if self.latched == Some(Fault::Fallen) {
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
        let is_known = self.is_planned() && walk.half_step().index == now.index;
        let planned = asked.angles - self.feedback.offsets().angles - self.landing.offsets().angles;
        is_known.then(|| AddedAngles::between(&self.mechanism, &walk.motion_at(now.progress).angles, &planned))
    }
}
