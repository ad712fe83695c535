//! Incremental replanning: a change that the loop itself makes, a stop or a step after a push, is planned over several
//! ticks, so that none of them takes long, and takes over at a coming knot.

use interface::WalkPose;

use crate::dynamics_filter::DynamicsFilter;
use crate::foot_trajectory::FootTrajectory;
use crate::gait_state::Goal;
use crate::knot::KNOT;
use crate::pattern_model::PatternModel;
use crate::step_choice::StepChoice;

/// A plan in the making.
#[derive(Clone, Debug)]
pub(crate) struct IncrementalReplan {
    change: PlanChange,
    /// Knots until it takes over; 0 when no plan is in the making.
    knots_left: u32,
    /// The feet at the knot where it takes over.
    foot_trajectory: FootTrajectory,
    /// The knots that follow.
    dynamics_filter: DynamicsFilter,
}

/// A change of the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PlanChange {
    /// The gait to change to.
    pub goal: Option<Goal>,
    /// Where and when the swing foot lands.
    pub step: Option<StepChoice>,
    /// Where the frame of the destination is, in the walk frame.
    pub course_frame: Option<WalkPose>,
}

impl PlanChange {
    /// Makes the change. Returns whether anything is different.
    pub(crate) fn apply(&self, model: &PatternModel, feet: &mut FootTrajectory) -> bool {
        let (before, had_destination) = (feet.footsteps.gait_state, feet.footsteps.course().is_some());
        if let Some(goal) = self.goal {
            feet.footsteps.set_goal(goal);
        }
        let has_destination = feet.footsteps.course().is_some();
        let is_redirected = self.course_frame.is_some() && has_destination;
        if let Some(frame) = self.course_frame {
            feet.footsteps.set_course_frame(frame);
        }
        let is_adjusted = self.step.is_some_and(|step| feet.adjust_step(model, &step));
        is_adjusted || is_redirected || has_destination != had_destination || feet.footsteps.gait_state != before
    }
}

impl IncrementalReplan {
    /// No plan in the making.
    pub(crate) fn idle(feet: &FootTrajectory, filter: &DynamicsFilter) -> Self {
        Self {
            change: PlanChange::default(),
            knots_left: 0,
            foot_trajectory: feet.clone(),
            dynamics_filter: filter.clone(),
        }
    }

    /// Begins to plan a change, and with it the change in the making, if there is one. Returns whether anything is to
    /// change.
    ///
    /// * `feet`, `filter` – the present plan
    /// * `elapsed` – time since the present knot (s)
    pub(crate) fn begin(
        &mut self,
        model: &PatternModel,
        feet: &FootTrajectory,
        filter: &DynamicsFilter,
        change: PlanChange,
        elapsed: f64,
    ) -> bool {
        self.change = PlanChange {
            goal: change.goal.or(self.change.goal),
            step: change.step.or(self.change.step),
            course_frame: change.course_frame.or(self.change.course_frame),
        };
        self.foot_trajectory.clone_from(feet);
        self.dynamics_filter.clone_from(filter);
        let knots = Self::knots_until_takeover(elapsed);
        for _ in 0..knots {
            if self.foot_trajectory.advance(model) {
                // The foot has landed meanwhile.
                self.change.step = None;
            }
            self.dynamics_filter.advance();
        }
        if !self.change.apply(model, &mut self.foot_trajectory) {
            self.cancel();
            return false;
        }
        // After a push a leg may nearly be too short for a coming knot: then the ZMP jumps by metres.
        let unexpected_max = self.change.step.map_or(f64::INFINITY, |_| model.proportions.unexpected_zmp_max);
        self.dynamics_filter.restart(model, &self.foot_trajectory, unexpected_max);
        self.knots_left = knots;
        true
    }

    /// Knots until a change that is commanded now takes over.
    ///
    /// * `elapsed` – time since the present knot (s)
    pub(crate) fn knots_until_takeover(elapsed: f64) -> u32 {
        // Half a knot suffices to plan all of it.
        if elapsed > KNOT / 2.0 { 2 } else { 1 }
    }

    /// Plans a part of it.
    ///
    /// * `elapsed` – time since the present knot (s)
    /// * `dt` – the part of it that passed since the last call (s)
    pub(crate) fn work(&mut self, model: &PatternModel, elapsed: f64, dt: f64) {
        if self.knots_left == 0 {
            return;
        }
        let until = f64::from(self.knots_left) * KNOT - (elapsed - dt);
        let missing = self.dynamics_filter.missing();
        let share = (missing as f64 * dt / until).ceil() as usize;
        for _ in 0..share.min(missing) {
            self.dynamics_filter.extend(model);
        }
    }

    /// Counts a knot that has passed. Returns the plan that takes over at this knot, if one does.
    pub(crate) fn pass_knot(&mut self, model: &PatternModel) -> Option<(&FootTrajectory, &DynamicsFilter)> {
        self.knots_left = self.knots_left.checked_sub(1)?;
        if self.knots_left > 0 {
            return None;
        }
        self.change = PlanChange::default();
        self.dynamics_filter.complete(model);
        Some((&self.foot_trajectory, &self.dynamics_filter))
    }

    /// The change in the making.
    pub(crate) fn change(&self) -> PlanChange {
        self.change
    }

    /// Drops the goal of the change in the making: another one is commanded.
    pub(crate) fn forget_goal(&mut self) {
        self.change.goal = None;
    }

    /// Ends it and returns the change that it was to make.
    pub(crate) fn cancel(&mut self) -> PlanChange {
        self.knots_left = 0;
        std::mem::take(&mut self.change)
    }
}
