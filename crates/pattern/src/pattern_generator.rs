//! The walking-pattern generator: modifies the half-steps, plans the centre of mass over them, and realises both.

mod destination;

pub use destination::Departure;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use gait::{GaitParameters, RangeCheck, Robot, Start, Walk, WalkError};
use interface::{Command, GaitChange, HalfStep, WalkPose, WalkVelocity};
use model::{Joint, Mechanism, Motion};
use nalgebra::Vector2;

use crate::execution::Execution;
use crate::foot_trajectory::{FootTrajectory, MeasuredBalance};
use crate::footprint::Footprint;
use crate::footstep_plan::FootstepPlan;
use crate::gait::Gait;
use crate::gait_phase::GaitPhase;
use crate::gait_state::{GaitState, Goal, Stance};
use crate::incremental_replan::PlanChange;
use crate::knot::{KNOT, Knot};
use crate::one_foot_stand;
use crate::pace::Pace;
use crate::pattern_model::PatternModel;
use crate::plan::Plan;
use crate::playback::Playback;
use crate::step_choice::StepChoice;
use crate::swing_clearance::BodyTilt;
use crate::whole_body_ik::WholeBodyIk;

/// Each step adjustment is a new plan: not more often than once in so many knots.
const KNOTS_BETWEEN_ADJUSTMENTS: u32 = 2;

/// A walk whose centre of mass is planned over the coming footsteps. It takes the place of the plain [`Walk`].
#[derive(Clone, Debug)]
pub struct PatternGenerator {
    model: Arc<PatternModel>,
    plan: Plan,
    execution: Execution,
}

impl PatternGenerator {
    /// A walk in stride, at the very beginning of its first half-step.
    pub fn walking(mechanism: &Mechanism, walk: Walk) -> Self {
        let model = one_foot_stand::model_of(mechanism, &walk);
        let motion = walk.motion();
        let feet = FootTrajectory::new(&model, FootstepPlan::walking(&model, walk));
        Self::begin(model, feet, &motion)
    }

    /// A stand with the feet side by side, from which a walk can be started.
    pub fn standing(mechanism: &Mechanism, walk: Walk) -> Self {
        let model = one_foot_stand::model_of(mechanism, &walk);
        let nominal = walk.motion().angles;
        let feet = FootTrajectory::new(&model, FootstepPlan::standing(&model, walk));
        let footprint = &feet.footsteps.feet;
        let middle = footprint.footprint.point_to_walk(footprint.lift_off.position.xy() / 2.0);
        let posture = WholeBodyIk::new(&model, &nominal).solve(&model, &feet.task(&model, middle));
        Self::begin(model, feet, &Motion::at_rest(posture.unwrap_or(nominal)))
    }

    /// The stand from which a robot's walk is started, as its joints are.
    ///
    /// # Errors
    /// The robot cannot walk by its half-step.
    pub fn standing_motion(robot: &Robot, gait: &GaitParameters) -> Result<Motion, WalkError> {
        let walk = Walk::new(robot.nominal.clone(), &robot.mechanism, gait, Start::default())?;
        Ok(Self::standing(&robot.mechanism, walk).physical_motion())
    }

    /// Begins with a motion in support coordinates.
    fn begin(model: PatternModel, feet: FootTrajectory, motion: &Motion) -> Self {
        let knot = Knot {
            angles: feet.to_physical(&model, &motion.angles),
            footprint: feet.footsteps.feet.footprint,
            landings: feet.footsteps.landings(&model),
            phase: feet.phase(),
            speed: feet.speed(),
            vertical: Vector2::zeros(),
            support_weight_share: feet.footsteps.gait_state.support_weight_share(),
        };
        // The second knot is the beginning; before it the motion was as it continues.
        let before = Knot {
            angles: feet.to_physical(&model, &(motion.angles - motion.rates * KNOT)),
            phase: knot.phase - knot.speed * KNOT / feet.footsteps.walk.table().duration,
            ..knot
        };
        let mut generator = Self {
            plan: Plan::new(&model, feet, motion),
            execution: Execution::new(&model.proportions, [knot; 4]),
            model: Arc::new(model),
        };
        generator.plan_knot();
        let next = *generator.execution.playback.newest();
        generator.plan_knot();
        let newest = *generator.execution.playback.newest();
        generator.execution.playback = Playback::new([before, knot, next, newest]);
        generator
    }

    /// Takes over the plan of `other`, a copy of this one whose plan was changed at the same
    /// [`revision`](Self::revision). Does not allocate.
    pub fn adopt(&mut self, other: &Self) {
        self.plan.clone_from(&other.plan);
        self.execution.playback.end_override_with_plan(self.plan.command().speed);
    }

    /// A number that differs whenever the plan does: the plan of a copy is still that of the original while both have
    /// the same revision.
    pub fn revision(&self) -> u64 {
        self.plan.revision()
    }

    /// The gait parameters of a steady walk at a velocity. They may be outside every range.
    pub fn command_at(&self, velocity: &WalkVelocity) -> Command {
        self.model.velocity.command(velocity, self.walk().limits())
    }

    /// Puts in force what the configured range admits of a change, as [`admit`](Gait::admit), and changes over to it at
    /// a pace. Unless that is [`Pace::AtOnce`], a start from a stand makes no nominal step first.
    pub fn admit_at(&mut self, pace: Pace, change: &GaitChange) -> RangeCheck {
        self.plan.admit(&self.model, &self.execution.playback, change, pace)
    }

    /// Plays the speed of a request from now on, if the robot walks. A plan for it must [follow](Self::adopt), or
    /// the override must be [cancelled](Self::cancel_speed_override).
    pub fn override_speed(&mut self, request: &GaitChange) {
        let footsteps = self.plan.footsteps();
        let target = footsteps.walk.grant(request, footsteps.command()).granted.speed;
        if footsteps.gait_state == GaitState::Walking
            && !footsteps.is_timed()
            && target != footsteps.walk.speed().target()
        {
            self.execution.playback.override_speed(footsteps.walk.speed(), target);
        }
    }

    /// Returns to the planned speed: no other was granted.
    pub fn cancel_speed_override(&mut self) {
        self.execution.playback.cancel_speed_override();
    }

    /// Changes to another gait and plans it at once, which takes about a millisecond; see
    /// [`set_goal_soon`](Self::set_goal_soon).
    pub fn set_goal(&mut self, goal: Goal) {
        self.plan.set_goal(&self.model, goal);
    }

    /// Changes to another gait within two knots. Planning is spread over the ticks until then.
    pub fn set_goal_soon(&mut self, goal: Goal) {
        self.replan_soon(PlanChange { goal: Some(goal), ..PlanChange::default() });
    }

    /// The pace at which the walk changes over to the command in force.
    pub(crate) fn pace(&self) -> Pace {
        self.plan.footsteps().pace()
    }

    /// The state of the gait at the newest knot.
    pub fn gait_state(&self) -> GaitState {
        self.plan.gait_state()
    }

    /// Plans a change over the coming ticks. Returns whether there is anything to change.
    fn replan_soon(&mut self, change: PlanChange) -> bool {
        self.plan.replan_soon(&self.model, change, self.execution.playback.elapsed())
    }

    /// The present motion of the physical joints.
    pub fn physical_motion(&self) -> Motion {
        self.execution.playback.physical_motion()
    }

    /// The robot as a tree.
    pub fn tree(&self) -> &dynamics::Tree {
        &self.model.tree
    }

    /// The present support foot.
    fn footprint(&self) -> &Footprint {
        &self.execution.playback.of_support(self.half_step().support).footprint
    }

    /// Goes to the next knot, whatever the time until then: a speed that is not planned yet counts as none.
    pub(crate) fn advance_to_next_knot(&mut self) {
        self.execution.playback.cancel_speed_override();
        self.plan_knot();
        self.seek(0.0);
    }

    /// Goes to a share of the time from the present knot to the next, which both are planned.
    pub(crate) fn seek(&mut self, share: f64) {
        self.execution.playback.seek(share);
    }

    /// Whether the support changes near the present knot.
    pub(crate) fn is_near_support_change(&self) -> bool {
        self.execution.playback.is_near_support_change()
    }

    /// Share of the time from the present knot to the next at which the support changes, if it does.
    pub(crate) fn share_at_support_change(&self) -> Option<f64> {
        self.execution.playback.share_at_support_change()
    }

    /// Plans and realises one more knot.
    fn plan_knot(&mut self) {
        let Self { model, plan, execution } = self;
        execution.knots_since_adjustment = execution.knots_since_adjustment.saturating_add(1);
        if plan.advance(model) {
            execution.change_support();
        }
        execution.slope.advance(KNOT);
        let vertical = execution.slope.planned();
        let mut task = plan.task(model, vertical);
        execution.clearance.advance(&model.proportions, execution.tilt, task.swing_sole.position.xy(), KNOT);
        task.swing_sole.position.z += execution.clearance.of_sole();
        task.hip_height += execution.clearance.of_hips() - model.lowered_on_slope(vertical);
        let knot = plan.realise(model, &task, execution.playback.newest(), vertical);
        execution.playback.push(knot);
    }
}

impl Gait for PatternGenerator {
    fn admit(&mut self, request: &GaitChange) -> RangeCheck {
        self.plan.admit(&self.model, &self.execution.playback, request, Pace::AtOnce)
    }

    fn advance(&mut self, dt: f64) -> bool {
        let before = self.half_step().index;
        let dt = dt.min(self.walk().table().duration).max(0.0);
        self.execution.playback.advance(dt);
        while self.execution.playback.passes_knot() {
            self.plan_knot();
        }
        let elapsed = self.execution.playback.elapsed();
        self.plan.work(&self.model, elapsed / KNOT, elapsed, dt);
        self.half_step().index != before
    }

    fn motion(&self) -> Motion {
        let mut motion = self.walk().mirror().to_support(self.half_step().support, &self.physical_motion());
        let [vertical, rate] =
            self.execution.playback.vertical().map(|vertical| self.footprint().direction_to_support(vertical));
        // The rotation that brings the vertical upright.
        (motion.angles[Joint::FootRoll], motion.angles[Joint::FootPitch]) = (vertical.y, -vertical.x);
        (motion.rates[Joint::FootRoll], motion.rates[Joint::FootPitch]) = (rate.y, -rate.x);
        motion
    }

    fn half_step(&self) -> HalfStep {
        self.execution.playback.half_step(self.walk().half_step())
    }

    fn speed(&self) -> f64 {
        self.execution.playback.speed()
    }

    fn command(&self) -> Command {
        self.plan.command()
    }

    /// What is planned for the newest knot, as far as it has begun.
    fn phase(&self) -> GaitPhase {
        match (self.gait_state(), self.in_double_support()) {
            (GaitState::Standing(stance), true) => GaitPhase::Standing(stance),
            (
                GaitState::Settling { .. }
                | GaitState::Standing(_)
                | GaitState::Stopping { .. }
                | GaitState::Returning { .. },
                _,
            ) => GaitPhase::Stopping,
            (_, true) => GaitPhase::Starting,
            (GaitState::Walking | GaitState::Starting { .. }, false) => GaitPhase::Walking,
            (GaitState::InPlace { .. }, false) => GaitPhase::InPlace,
        }
    }

    fn landings(&self) -> [WalkPose; 2] {
        self.execution.playback.of_support(self.half_step().support).landings
    }

    fn walk(&self) -> &Walk {
        self.plan.walk()
    }

    fn stop(&mut self, stance: Stance) -> u64 {
        let goal = Goal::Stand(stance);
        self.set_goal_soon(goal);
        let mut stopping = self.gait_state();
        stopping.set_goal(goal, self.model.weight_shift);
        u64::from(stopping.half_steps_to_goal())
    }

    fn can_restart(&self) -> bool {
        true
    }

    fn follows_walk(&self) -> bool {
        true
    }

    fn in_double_support(&self) -> bool {
        self.execution.playback.support_weight_share() < 1.0
    }

    fn is_leg_out_of_reach(&self) -> bool {
        self.plan.is_leg_out_of_reach()
    }

    fn sensed_vertical(&self) -> Vector2<f64> {
        self.footprint().direction_to_support(self.execution.slope.sensed())
    }

    fn update_ground_slope(&mut self, lean: Vector2<f64>, dt: f64) {
        self.execution.slope.update(self.footprint().direction_to_walk(lean), dt);
    }

    fn set_tilt(&mut self, tilt: BodyTilt) {
        // Just before a support change the newest knot has other support coordinates.
        if self.walk().half_step().index == self.half_step().index {
            self.execution.tilt = tilt;
        }
    }

    fn choose_step(&self, measured: &MeasuredBalance) -> Option<StepChoice> {
        let is_same_half_step = self.walk().half_step().index == self.half_step().index;
        let is_rested = self.execution.knots_since_adjustment >= KNOTS_BETWEEN_ADJUSTMENTS;
        if !is_same_half_step || !is_rested {
            return None;
        }
        self.plan.choose_step(&self.model, measured, self.execution.playback.elapsed())
    }

    fn shortfall(&self, measured: &MeasuredBalance) -> Option<Vector2<f64>> {
        let is_same_half_step = self.walk().half_step().index == self.half_step().index;
        let elapsed = self.execution.playback.elapsed();
        is_same_half_step.then(|| self.plan.shortfall(&self.model, measured, elapsed)).flatten()
    }

    fn adjust_step(&mut self, choice: StepChoice) {
        let change = PlanChange { step: Some(choice), ..PlanChange::default() };
        if self.replan_soon(change) {
            self.execution.knots_since_adjustment = 0;
        }
    }
}
