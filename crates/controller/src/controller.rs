//! The controller: one tick, read from top to bottom.

mod balance;
mod destination;
mod estimation;
mod requests;
mod robot_posture;

use std::sync::Arc;

use dynamics::{Kinematics, PlannedContact, ReferenceDynamics, Tree};
use gait::{NominalTable, Start, Walk, WalkError};
use interface::{
    AddedAngles, Fault, Faults, Intent, LatchedFault, Measurement, Mode, Reason, Rejection, Reply, Report, Setpoint,
    Source, StateEstimate, SteadyWalk,
};
use model::{ComState, JointVector, Mechanism, Motion, Side};
use nalgebra::Vector2;
use pattern::{FeasibilityCheck, PatternGenerator, Stance, VelocityMap};
use stabilizer::{
    AttitudeEstimator, CapturabilityEstimator, ComFilter, ContactEstimate, DcmFeedback, GroundSlopeFilter,
    LandingCompliance, SupportFoot, WalkOdometry, ZmpEstimator,
};

use crate::admission_control::AdmissionControl;
use crate::admission_job::AdmissionJob;
use crate::command_arbiter::CommandArbiter;
use crate::drive_deflection::DriveDeflection;
use crate::gravity_consistency::GravityConsistency;
use crate::joint_limiter::JointLimiter;
use crate::joint_residual::JointResidual;
use crate::measurement_validator::MeasurementValidator;
use crate::operating_state::OperatingState;
use crate::parameters::Parameters;
use crate::pattern::{Compensation, Pattern};
use crate::report::{Tick, added_angles, to_physical};

/// Shortest period that a tick plays (s): rates are differences over it.
const PERIOD_MIN: f64 = 1e-6;
/// Longest period that a tick plays (s), shorter than any half-step: what a loop was late by beyond it is lost.
const PERIOD_MAX: f64 = 0.1;

/// The state of the controller. Everything is allocated in [`Controller::new`]; a tick allocates nothing.
#[derive(Clone, Debug)]
pub struct Controller {
    mechanism: Mechanism,
    tree: Tree,
    state: OperatingState,
    arbiter: CommandArbiter,
    admission: AdmissionControl,
    pattern: Pattern,
    /// The stand to return to after a fall.
    rest: Box<PatternGenerator>,
    validator: MeasurementValidator,
    kinematics: Kinematics,
    zmp_estimator: ZmpEstimator,
    contact: ContactEstimate,
    /// Rotation of the robot beyond the plan about x and y of support coordinates, as last measured (rad).
    tilt: Vector2<f64>,
    /// The support foot as last measured, while it bears.
    support_foot: Option<SupportFoot>,
    ground_slope: GroundSlopeFilter,
    deflection: DriveDeflection,
    reference: ReferenceDynamics,
    feedback: DcmFeedback,
    landing: LandingCompliance,
    limiter: JointLimiter,
    /// The setpoint of the last tick, if the robot is to follow it.
    last_setpoint: Option<Setpoint>,
    /// The part of its angles by which feedback leans on the ground (rad).
    yielding: JointVector,
    residual: JointResidual,
    /// The last valid joint angles (rad).
    measured_angles: Option<JointVector>,
    /// The joint by which the robot was found in another posture than the controller begins in, while it holds it.
    unexpected_posture: Option<Rejection>,
    gravity: GravityConsistency,
    attitude: AttitudeEstimator,
    com_filter: ComFilter,
    /// Time since the last sample that could be used (s).
    since_sample: f64,
    /// Whether a sensor was at fault in the last sample.
    has_sensor_fault: bool,
    capturability: CapturabilityEstimator,
    odometry: WalkOdometry,
    /// Who sent the destination to which the robot walks, or walked last.
    destination_source: Option<Source>,
    velocity_map: VelocityMap,
    /// For how long measurements have called for another step (s).
    push_seen_for: f64,
    /// Time since the first tick began (s).
    time: f64,
    /// The latched fault as of the last tick.
    latched: Option<LatchedFault>,
}

impl Controller {
    /// A controller at the beginning of its first half-step. Everything that could go wrong later is checked here.
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
        if parameters.compensation == Compensation::None {
            Walk::check_joints(mechanism)?;
        }
        let pattern = Pattern::new(mechanism, walk.clone(), parameters.compensation);
        let rest = Box::new(PatternGenerator::standing(mechanism, walk.clone()));
        Ok(Self::with_pattern(mechanism, parameters, &walk, pattern, rest, Intent::Walk))
    }

    /// A controller of a robot that stands with its feet side by side and walks when requested to. Its gait is planned,
    /// whatever the parameters say about compensation.
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
        let rest = Box::new(PatternGenerator::standing(mechanism, walk.clone()));
        let pattern = Pattern::Planned(rest.clone());
        Ok(Self::with_pattern(mechanism, parameters, &walk, pattern, rest, Intent::Stop))
    }

    // It needs a large part of a thread's stack: the patterns are made before, when that is free.
    #[inline(never)]
    fn with_pattern(
        mechanism: &Mechanism,
        parameters: &Parameters,
        walk: &Walk,
        pattern: Pattern,
        rest: Box<PatternGenerator>,
        intent: Intent,
    ) -> Self {
        let tree = Tree::new(mechanism);
        let gait = pattern.gait();
        let mut reference = ReferenceDynamics::new(mechanism, &tree, walk.mirror());
        reference.update(&tree, walk.mirror(), &gait.motion(), gait.contact());
        let first = walk.mirror().to_physical(gait.half_step().support, &gait.motion().angles);
        let odometry = WalkOdometry::new(mechanism, reference.kinematics(), gait.half_step().support);
        let check = FeasibilityCheck::new(mechanism, reference.clone(), parameters.feasibility);
        Self {
            state: OperatingState::new(intent),
            arbiter: CommandArbiter::new(parameters.arbiter),
            admission: AdmissionControl::new(AdmissionJob::new(check, &rest)),
            validator: MeasurementValidator::new(mechanism, parameters.validator),
            kinematics: Kinematics::default(),
            zmp_estimator: ZmpEstimator::new(mechanism, parameters.stabilizer.zmp),
            contact: ContactEstimate::AIRBORNE,
            tilt: Vector2::zeros(),
            support_foot: None,
            ground_slope: GroundSlopeFilter::new(mechanism),
            deflection: DriveDeflection::new(mechanism),
            feedback: DcmFeedback::new(mechanism, parameters.stabilizer.feedback),
            landing: LandingCompliance::new(mechanism, parameters.stabilizer.landing),
            limiter: JointLimiter::new(mechanism, &first),
            last_setpoint: None,
            yielding: JointVector::ZERO,
            residual: JointResidual::default(),
            measured_angles: None,
            unexpected_posture: None,
            gravity: GravityConsistency::default(),
            attitude: AttitudeEstimator::default(),
            com_filter: ComFilter::new(mechanism),
            capturability: CapturabilityEstimator::new(mechanism),
            since_sample: 0.0,
            has_sensor_fault: false,
            odometry,
            destination_source: None,
            velocity_map: VelocityMap::new(mechanism, walk.table()),
            push_seen_for: 0.0,
            time: 0.0,
            latched: None,
            rest,
            mechanism: mechanism.clone(),
            tree,
            pattern,
            reference,
        }
    }

    /// One control period. Returns for every input.
    ///
    /// * `dt` – its length (s); what is not a number or outside 1 µs to 0.1 s is played as the nearest of these
    /// * `measurement` – the newest one, if a new one arrived since the last tick
    pub fn tick(&mut self, dt: f64, measurement: Option<&Measurement>) -> Tick {
        let mut faults = Faults::default();
        let dt = playable(dt);

        // Does the source in control still send?
        if let Some(silent) = self.arbiter.advance(dt, self.admission.waiting())
            && self.state.intent().steps()
            && !self.walks_for_a_superior_of(silent)
        {
            self.stop(Stance::Parallel);
        }

        // Where is the robot? A measurement answers the setpoint of the tick before: `reference` is still that one's.
        let com_measured = self.estimate(measurement, dt, &mut faults);
        self.check_gravity(com_measured.as_ref(), dt, &mut faults);

        // What does balance command? No new sample is no reason to take the error for none.
        let com = self.com_filter.com(&self.reference.com);
        self.balance(com, dt);

        // What does the gait command?
        let support = self.pattern.gait().half_step().support;
        let commanded = self.advance(dt);
        if self.pattern.gait().is_leg_out_of_reach() {
            faults.insert(Fault::OutOfReach);
        }

        self.follow_destination();

        // What do the joints permit?
        let setpoint = self.limit(&commanded, dt, &mut faults);
        if faults.contains(Fault::SetpointNotFinite) {
            self.latch(Fault::SetpointNotFinite);
        }

        self.last_setpoint = Some(setpoint);
        self.time += dt;
        self.note_latched();

        // What was measured before a support change is in the frame of the other foot.
        let is_same_foot = self.pattern.gait().half_step().support == support;
        Tick {
            rejection: self.rejection(),
            setpoint,
            report: self.report(&commanded, com_measured.and(com), is_same_foot, faults),
            command: self.pattern.gait().command(),
            reply: self.admission.take_reply().map(|reply| self.complete_reply(reply)),
            superseded: self.admission.take_superseded().map(|reply| self.complete_reply(reply)),
            latched: self.latched,
        }
    }

    /// Notes since when the fault is latched that is.
    fn note_latched(&mut self) {
        let fault = self.state.latched();
        if fault != self.latched.map(|latched| latched.fault) {
            let cause = self.rejection().filter(|_| fault != Some(Fault::Fallen));
            self.latched = fault.map(|fault| LatchedFault { fault, time: self.time, cause });
        }
    }

    /// Why the newest measurement was not used, if it was not, or why the robot is held where it was found.
    fn rejection(&self) -> Option<Rejection> {
        self.unexpected_posture.or(self.validator.rejection())
    }

    /// A reply with the state of the controller as it leaves.
    fn complete_reply(&self, reply: Reply) -> Reply {
        let steady = || self.velocity_map.steady_walk(&reply.granted);
        let walk = if reply.walk == SteadyWalk::ZERO { steady() } else { reply.walk };
        Reply { mode: Some(self.mode()), latched: self.latched, walk, ..reply }
    }

    /// Adds an angle to each joint's setpoint from the next tick on (rad), at most 0.3 rad either way, until it is set
    /// anew; a critically damped lag of 20 ms follows it. The sum passes the limits of the joints; NaN adds nothing.
    /// The controller knows of it: a joint that follows is no fault. A posture that is held has none.
    pub fn set_joint_residual(&mut self, residual: &JointVector) {
        self.residual.set(residual);
    }

    /// What the controller is doing.
    pub fn mode(&self) -> Mode {
        self.state.mode(self.pattern.gait().phase())
    }

    /// Stops, and refuses the request under evaluation: no late answer undoes a stop. Returns the index of the
    /// half-step in which the robot will stand.
    fn stop(&mut self, stance: Stance) -> u64 {
        self.state.set_intent(if stance == Stance::Parallel { Intent::Stop } else { Intent::Hold });
        self.admission.cancel(self.refused(Reason::Superseded));
        if let Pattern::Planned(generator) = &mut self.pattern {
            generator.cancel_speed_override();
        }
        let gait = self.pattern.gait_mut();
        gait.half_step().index + gait.stop(stance)
    }

    /// Latches a fault until a reset; a walk stops.
    fn latch(&mut self, fault: Fault) {
        if self.state.latch(fault) {
            self.stop(Stance::Stride);
        }
    }

    /// Whether the joints follow the walk, so that feedback applies.
    fn follows_walk(&self) -> bool {
        self.state.plays_gait() && self.pattern.gait().follows_walk()
    }

    /// Moves on by a period and returns the commanded motion in support coordinates, feedback included.
    fn advance(&mut self, dt: f64) -> Motion {
        if self.state.holds_posture() {
            return Motion::default();
        }
        if let Some(recovery) = self.state.advance_recovery(dt) {
            let gait = self.pattern.gait();
            let mirror = gait.walk().mirror();
            let motion = mirror.to_support(gait.half_step().support, &recovery);
            self.reference.update(&self.tree, mirror, &motion, PlannedContact::BothFeet);
            return motion + *self.feedback.offsets();
        }
        let gait = self.pattern.gait_mut();
        if gait.advance(dt) {
            self.odometry.support_on(gait.half_step().support);
            let mirror = gait.walk().mirror();
            // The swing foot as it landed: the reference is still that of the tick before.
            let landed = self.reference.kinematics().rotation[self.tree.foot(Side::Left)];
            let heading = landed.column(0).xy().try_normalize(f64::EPSILON).unwrap_or_else(Vector2::x);
            self.feedback.change_support(mirror, heading);
            self.landing.change_support(mirror);
            self.zmp_estimator.change_support(mirror);
            self.contact.change_support();
            self.support_foot = None;
            self.ground_slope.change_support(heading);
            self.com_filter.change_support(heading);
        }
        let motion = gait.motion();
        self.reference.update(&self.tree, gait.walk().mirror(), &motion, gait.contact());
        self.landing.advance(&self.tree, self.reference.kinematics(), &motion.angles, dt);
        motion + *self.feedback.offsets() + *self.landing.offsets()
    }

    /// Brings the commanded motion back to physical joints and through the limiter.
    fn limit(&mut self, commanded: &Motion, dt: f64, faults: &mut Faults) -> Setpoint {
        if self.state.holds_posture() {
            return self.limiter.hold();
        }
        let gait = self.pattern.gait();
        let (support, mirror) = (gait.half_step().support, gait.walk().mirror());
        let motion = self.residual.added_to(mirror.to_physical(support, commanded), dt);
        let torques = mirror.to_physical(support, &self.reference.torques);
        self.yielding = mirror.to_physical(support, &self.feedback.offsets().angles);
        self.limiter.limit(&motion, &torques, dt, faults)
    }

    fn report(&self, commanded: &Motion, com_measured: Option<ComState>, is_same_foot: bool, faults: Faults) -> Report {
        let gait = self.pattern.gait();
        let has_plan = !self.state.holds_posture();
        to_physical(Report {
            mode: self.mode(),
            half_step: gait.half_step(),
            speed: gait.speed(),
            turn: gait.command().turn,
            extension: gait.command().extension,
            sidestep: gait.command().sidestep,
            odometry: self.odometry.report(&gait.landings()),
            destination: self.destination_progress(),
            zmp_in_support: self.contact.zmp,
            zmp_planned: has_plan.then_some(self.reference.zmp),
            margin: Some(self.contact.margin).filter(|margin| margin.is_finite()),
            lean: self.feedback.lean(),
            added: self.added(commanded),
            capturability: self.capturability(),
            estimate: StateEstimate {
                contact: self.contact.in_contact,
                external_force: self.com_filter.external_acceleration() * self.tree.mass,
                com_offset: self.com_filter.com_offset(),
                gyro_bias: self.attitude.gyro_bias(),
            },
            com_planned: has_plan.then_some(self.reference.com),
            com_measured: com_measured.filter(|_| is_same_foot),
            faults,
        })
    }

    /// What the plan adds to the plain sum of the modifications. The walk is known at the newest knot, a little ahead
    /// of now: just before a support change only in the frame of the other foot.
    fn added(&self, commanded: &Motion) -> Option<AddedAngles> {
        let gait = self.pattern.gait();
        let (walk, now) = (gait.walk(), gait.half_step());
        let is_known = self.follows_walk() && walk.half_step().index == now.index;
        let planned = commanded.angles - self.feedback.offsets().angles - self.landing.offsets().angles;
        is_known.then(|| added_angles(&self.mechanism, &walk.motion_at(now.progress).angles, &planned))
    }
}

/// The length of a period that a tick plays: within [`PERIOD_MIN`] and [`PERIOD_MAX`] for every number.
fn playable(dt: f64) -> f64 {
    if dt > PERIOD_MIN { dt.min(PERIOD_MAX) } else { PERIOD_MIN }
}
