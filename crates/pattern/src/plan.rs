//! The plan: the motion from the newest knot on. Another plan can take its place as a whole.

use dynamics::Kinematics;
use gait::{RangeCheck, Walk};
use interface::{Command, GaitChange, WalkPose};
use model::Motion;
use nalgebra::Vector2;

use crate::course::Course;
use crate::dynamics_filter::DynamicsFilter;
use crate::foot_trajectory::{FootTrajectory, MeasuredBalance};
use crate::footprint::Footprint;
use crate::footstep_plan::FootstepPlan;
use crate::gait_state::{GaitState, Goal};
use crate::incremental_replan::{IncrementalReplan, PlanChange};
use crate::knot::{KNOT, Knot};
use crate::pace::Pace;
use crate::pattern_model::PatternModel;
use crate::playback::Playback;
use crate::preview_controller::CartState;
use crate::step_choice::StepChoice;
use crate::whole_body_ik::{WholeBodyIk, WholeBodyTask};

/// The footsteps, the centre of mass over them and the posture, at the newest knot.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    foot_trajectory: FootTrajectory,
    dynamics_filter: DynamicsFilter,
    replan: IncrementalReplan,
    /// Correction of the centre of mass for the dynamics of the whole body, along x and y of the walk frame.
    correction: [CartState; 2],
    body: WholeBodyIk,
    /// Where the feet land after the newest knot; see [`FootstepPlan::landings`].
    landings: [WalkPose; 2],
    /// Differs whenever the plan does.
    revision: u64,
    /// Whether a leg was too short for the newest knot.
    is_leg_out_of_reach: bool,
}

impl Plan {
    /// The plan of a motion that begins now.
    ///
    /// * `motion` – in support coordinates
    pub(crate) fn new(model: &PatternModel, feet: FootTrajectory, motion: &Motion) -> Self {
        let kinematics = Kinematics::fixed_base(&model.tree, &motion.angles);
        let com = cart_states(
            &feet.footsteps.feet.footprint,
            kinematics.com(&model.tree).xy(),
            kinematics.com_velocity(&model.tree, &motion.rates).0.xy(),
        );
        let dynamics_filter = DynamicsFilter::new(model, &feet, com, motion);
        Self {
            replan: IncrementalReplan::idle(&feet, &dynamics_filter),
            dynamics_filter,
            correction: [CartState::zeros(); 2],
            body: WholeBodyIk::new(model, &motion.angles),
            landings: feet.footsteps.landings(model),
            revision: 0,
            is_leg_out_of_reach: false,
            foot_trajectory: feet,
        }
    }

    /// Differs whenever the plan does.
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    /// The footsteps at the newest knot.
    pub(crate) fn footsteps(&self) -> &FootstepPlan {
        &self.foot_trajectory.footsteps
    }

    /// The walk at the newest knot.
    pub(crate) fn walk(&self) -> &Walk {
        &self.footsteps().walk
    }

    /// The state of the gait at the newest knot.
    pub(crate) fn gait_state(&self) -> GaitState {
        self.footsteps().gait_state
    }

    /// The command in force, or in force once the robot walks.
    pub(crate) fn command(&self) -> Command {
        self.footsteps().command()
    }

    /// Whether a leg was too short for the newest knot, so that the posture before was kept.
    pub(crate) fn is_leg_out_of_reach(&self) -> bool {
        self.is_leg_out_of_reach
    }

    /// Puts in force what the limits of the gait grant of a request, and plans it; see [`Walk::admit`].
    ///
    /// * `playback` – whose speed override, if there is one, the plan takes over
    /// * `pace` – at which the walk changes over to it
    pub(crate) fn admit(
        &mut self,
        model: &PatternModel,
        playback: &Playback,
        request: &GaitChange,
        pace: Pace,
    ) -> RangeCheck {
        let (before, had_destination) = (self.command(), self.footsteps().course().is_some());
        let footsteps = &mut self.foot_trajectory.footsteps;
        let mut admission = footsteps.admit(request, pace);
        let speed = footsteps.walk.speed().target();
        if speed != before.speed
            && let Some(overriding) = playback.overriding_speed_at_newest(speed)
        {
            footsteps.walk.take_over_speed(overriding);
        }
        if self.command() != before || self.footsteps().course().is_some() != had_destination {
            if pace == Pace::InStep
                && let Some(effect_half_step) = self.foot_trajectory.redirect(model)
            {
                admission.effect_half_step = effect_half_step;
            }
            self.replan_at_once(model);
        }
        admission
    }

    /// Walks to a destination at a speed factor, from a stand if the robot is to stop first, and plans it at once.
    pub(crate) fn follow(&mut self, model: &PatternModel, course: Course, speed: f64, stops_first: bool) {
        let footsteps = &mut self.foot_trajectory.footsteps;
        footsteps.admit(&GaitChange { speed: Some(speed), ..GaitChange::NONE }, Pace::AtOnce);
        footsteps.follow(course, stops_first);
        self.replan.forget_goal();
        self.replan_at_once(model);
    }

    /// Changes to another gait, and plans it at once.
    pub(crate) fn set_goal(&mut self, model: &PatternModel, goal: Goal) {
        let (before, had_destination) = (self.gait_state(), self.footsteps().course().is_some());
        let overruled = self.replan.change().goal;
        self.foot_trajectory.footsteps.set_goal(goal);
        if self.gait_state() != before || had_destination || overruled.is_some_and(|overruled| overruled != goal) {
            self.replan.forget_goal();
            self.replan_at_once(model);
        }
    }

    /// Where and when the swing foot should land, if that is worth another plan, and in time once it is planned.
    ///
    /// * `elapsed` – time since the present knot (s)
    pub(crate) fn choose_step(
        &self,
        model: &PatternModel,
        measured: &MeasuredBalance,
        elapsed: f64,
    ) -> Option<StepChoice> {
        self.foot_trajectory.choose_step(model, &self.landings, measured, takeover(elapsed))
    }

    /// The error of the divergent component that the best step leaves (m); `None` late in a half-step, and in a stand.
    ///
    /// * `elapsed` – time since the present knot (s)
    pub(crate) fn shortfall(
        &self,
        model: &PatternModel,
        measured: &MeasuredBalance,
        elapsed: f64,
    ) -> Option<Vector2<f64>> {
        let problem = self.foot_trajectory.step_problem(model, &self.landings, measured, takeover(elapsed))?;
        Some(problem.shortfall())
    }

    /// Plans a change over the coming ticks. Returns whether there is anything to change.
    ///
    /// * `elapsed` – time since the present knot (s)
    pub(crate) fn replan_soon(&mut self, model: &PatternModel, change: PlanChange, elapsed: f64) -> bool {
        let Self { foot_trajectory, dynamics_filter, replan, .. } = self;
        let changes = replan.begin(model, foot_trajectory, dynamics_filter, change, elapsed);
        if changes {
            self.revision += 1;
        }
        changes
    }

    /// Plans anew what follows the newest knot.
    fn replan_at_once(&mut self, model: &PatternModel) {
        // The change in the making is made at once.
        self.replan.cancel().apply(model, &mut self.foot_trajectory);
        self.dynamics_filter.recompute(model, &self.foot_trajectory);
        self.landings = self.footsteps().landings(model);
        self.revision += 1;
    }

    /// Does a tick's share of planning.
    ///
    /// * `share` – share of the time to the next knot that has passed
    /// * `elapsed` – time since the present knot (s)
    /// * `dt` – time since the last tick (s)
    pub(crate) fn work(&mut self, model: &PatternModel, share: f64, elapsed: f64, dt: f64) {
        self.dynamics_filter.keep_up(model, share);
        self.replan.work(model, elapsed, dt);
    }

    /// Advances feet and centre of mass by a knot. Returns whether the support foot changed.
    pub(crate) fn advance(&mut self, model: &PatternModel) -> bool {
        self.dynamics_filter.complete(model);
        let input = self.dynamics_filter.correction_input();
        self.correction = [0, 1].map(|axis| model.correction_controller.advance(&self.correction[axis], input[axis]));
        self.dynamics_filter.advance();
        let changes_support = self.foot_trajectory.advance(model);
        if changes_support {
            self.body.change_support(model);
        }
        let replanned = self.replan.pass_knot(model);
        let is_replanned = replanned.is_some();
        if let Some((foot_trajectory, dynamics_filter)) = replanned {
            self.foot_trajectory.clone_from(foot_trajectory);
            self.dynamics_filter.clone_from(dynamics_filter);
        }
        if changes_support || is_replanned {
            self.landings = self.footsteps().landings(model);
        }
        changes_support
    }

    /// The task of the whole body at the newest knot.
    ///
    /// * `vertical` – lean of the vertical over the floor, in the walk frame (-)
    pub(crate) fn task(&self, model: &PatternModel, vertical: Vector2<f64>) -> WholeBodyTask {
        let correction = Vector2::new(self.correction[0].x, self.correction[1].x) + model.uphill(vertical);
        self.dynamics_filter.task(&self.footsteps().feet.footprint, correction)
    }

    /// Realises a task as the newest knot. A leg that is too short keeps the posture before.
    ///
    /// * `before` – the knot before
    /// * `vertical` – lean of the vertical over the floor, in the walk frame (-)
    pub(crate) fn realise(
        &mut self,
        model: &PatternModel,
        task: &WholeBodyTask,
        before: &Knot,
        vertical: Vector2<f64>,
    ) -> Knot {
        let solution = self.body.solve(model, task);
        self.is_leg_out_of_reach = solution.is_err();
        let angles = solution.map_or(before.angles, |angles| self.foot_trajectory.to_physical(model, &angles));
        self.revision += 1;
        Knot {
            angles,
            footprint: self.footsteps().feet.footprint,
            landings: self.landings,
            phase: self.foot_trajectory.phase(),
            speed: self.foot_trajectory.speed(),
            vertical,
            support_weight_share: self.gait_state().support_weight_share(),
        }
    }
}

#[cfg(test)]
impl Plan {
    /// Where the divergent component should be at the coming touchdown (m).
    pub(crate) fn dcm_at_touchdown(&self, model: &PatternModel) -> Vector2<f64> {
        self.foot_trajectory.dcm_at_touchdown(model, &self.landings)
    }

    /// Stops the walk where it is, within a knot.
    pub(crate) fn hold_speed(&mut self) {
        self.foot_trajectory.footsteps.walk.change_speed_within(0.0, KNOT);
    }

    /// Whether the knots that were planned ahead stand on the footsteps that will be made.
    pub(crate) fn foresees_its_footsteps(&self, model: &PatternModel) -> bool {
        let mut ahead = self.footsteps().clone();
        let foreseen = self.dynamics_filter.farthest_footsteps();
        let end = foreseen.walk.half_step();
        for _ in 0..1000 {
            let now = ahead.walk.half_step();
            if now.index == end.index && now.progress >= end.progress - 1e-9 {
                break;
            }
            ahead.advance(model);
        }
        let [made, planned] = [&ahead, foreseen].map(|plan| plan.feet.footprint.pose());
        (made.x - planned.x).abs().max((made.y - planned.y).abs()) < 1e-9
            && (made.heading - planned.heading).abs() < 1e-9
            && ahead.walk.half_step().index == end.index
    }
}

/// Knots until a change of the plan takes over, and knots from now until it is played.
///
/// * `elapsed` – time since the present knot (s)
fn takeover(elapsed: f64) -> [u32; 2] {
    let knots = IncrementalReplan::knots_until_takeover(elapsed);
    [knots, (2.0 + f64::from(knots) - elapsed / KNOT).round() as u32]
}

/// The centre of mass along x and y of the walk frame, from its position (m) and velocity (m/s) in support coordinates.
fn cart_states(footprint: &Footprint, position: Vector2<f64>, velocity: Vector2<f64>) -> [CartState; 2] {
    let position = footprint.point_to_walk(position);
    let velocity = footprint.direction_to_walk(velocity);
    [0, 1].map(|axis| CartState::new(position[axis], velocity[axis], 0.0))
}
