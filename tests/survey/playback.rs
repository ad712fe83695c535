//! Playback: the modified half-step with the paper's constant lean, played to the plant without a controller.
//!
//! The lean flips its side at every support change. No body can jump, so it goes over within [`FLIP`]. The ankle
//! feedback that the controller has may be switched on, so that a fall is not for lack of it.

use std::sync::Arc;

use dynamics::{Kinematics, PlannedContact, ReferenceDynamics, Tree};
use gait::{GaitParameters, NominalTable, Start, Walk, interpolate};
use interface::{Command, Measurement, SensorGroups, Setpoint};
use model::{ComState, Mechanism, Mirrored, Motion};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use paper::PaperLean;
use plant::Plant;
use stabilizer::{
    BalanceState, ContactEstimate, DcmFeedback, FeedbackParameters, SupportFrameMeasurement, estimate_com,
};

use halfstep_tests::walking::PERIOD;

/// How long the lean takes from one side to the other (s).
const FLIP: f64 = 0.06;

/// A walk that nobody controls.
pub(crate) struct Playback {
    /// Where it begins, in physical joints.
    #[cfg(feature = "mujoco")]
    pub start: Motion,
    tree: Tree,
    walk: Walk,
    lean: PaperLean,
    /// Since the last support change (s).
    since_support_change: f64,
    plan: ReferenceDynamics,
    feedback: DcmFeedback,
    kinematics: Kinematics,
    plant: Plant,
    measured: Measurement,
}

impl Playback {
    /// At the beginning of a half-step of the steady walk at `speed`, leaning.
    pub(crate) fn begin(
        mechanism: &Mechanism,
        table: Arc<NominalTable>,
        gait: &GaitParameters,
        plant: &plant::PlantParameters,
        feedback: FeedbackParameters,
        speed: f64,
        lean: PaperLean,
    ) -> Self {
        let start = Start { command: Command { speed, ..Command::NOMINAL }, ..Start::default() };
        let walk = Walk::new(table, mechanism, gait, start).expect("the committed nominal walks at this speed");
        let tree = Tree::new(mechanism);
        let start = lean.lean(&walk.motion());
        let mut plant = Plant::new(mechanism, plant, &start, PERIOD, 0);
        let measured = plant.measure();
        let mut plan = ReferenceDynamics::new(mechanism, &tree, walk.mirror());
        plan.update(&tree, walk.mirror(), &lean.lean(&walk.motion()), PlannedContact::SupportFoot);
        Self {
            #[cfg(feature = "mujoco")]
            start,
            feedback: DcmFeedback::new(mechanism, feedback),
            kinematics: Kinematics::default(),
            since_support_change: f64::INFINITY,
            tree,
            walk,
            lean,
            plan,
            plant,
            measured,
        }
    }

    /// When it falls (s); `None` if it walks so many seconds.
    pub(crate) fn falls_within(&mut self, seconds: f64) -> Option<f64> {
        self.falls_in(seconds, Plant::step)
    }

    /// The same with the plant moved on by `step`: by another engine, for example.
    pub(crate) fn falls_in(
        &mut self,
        seconds: f64,
        mut step: impl FnMut(&mut Plant, &Setpoint) -> Measurement,
    ) -> Option<f64> {
        while self.plant.time() < seconds {
            self.tick(&mut step);
            if self.plant.truth().has_fallen() {
                return Some(self.plant.time());
            }
        }
        None
    }

    fn tick(&mut self, step: impl FnOnce(&mut Plant, &Setpoint) -> Measurement) {
        // Balance answers what was sensed, told from the foot that bore then.
        let sensed = self.centre_of_mass();
        let sensed = BalanceState { com: sensed, tilt: Vector2::zeros(), zmp: None, foot: None };
        self.feedback.update(&BalanceState::planned(&self.plan), Some(&sensed), false, PERIOD);
        self.since_support_change += PERIOD;
        if self.walk.advance(PERIOD) {
            self.feedback.change_support(self.walk.mirror(), Vector2::x());
            self.since_support_change = 0.0;
        }

        let leaning = self.walk.motion() + self.flipped();
        self.plan.update(&self.tree, self.walk.mirror(), &leaning, PlannedContact::SupportFoot);
        let asked = leaning + *self.feedback.offsets();
        let mirror = self.walk.mirror();
        let support = self.walk.half_step().support;
        let (asked, torques) = (mirror.to_physical(support, &asked), mirror.to_physical(support, &self.plan.torques));
        let setpoint = Setpoint { angles: asked.angles, rates: asked.rates, feed_forward: torques };
        self.measured = step(&mut self.plant, &setpoint);
    }

    /// What is added of the lean now, in support coordinates: from what it was, on the other foot, to what it is to be.
    fn flipped(&self) -> Motion {
        let wanted = Motion::at_rest(self.lean.offsets());
        let before = wanted.mirrored(self.walk.mirror());
        interpolate(&before, &wanted, (self.since_support_change / FLIP).min(1.0), FLIP)
    }

    fn centre_of_mass(&mut self) -> ComState {
        let up = UnitQuaternion::new_unchecked(self.measured.orientation).inverse() * Vector3::z();
        let (support, mirror) = (self.walk.half_step().support, self.walk.mirror());
        let sensed = SupportFrameMeasurement::new(support, mirror, &self.measured, up, SensorGroups::NONE);
        self.kinematics.compute_fixed_base(&self.tree, &sensed.angles);
        estimate_com(&self.tree, &self.kinematics, &sensed, &ContactEstimate::AIRBORNE)
    }
}
