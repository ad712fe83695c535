//! The step after a push: what the choice of a step is made from, and what it changes.

use dynamics::pose_seen_from;
use interface::WalkPose;
use model::Side;
use nalgebra::{Vector2, Vector3};

use super::FootTrajectory;
use crate::footprint::rotation_about_z;
use crate::gait_state::{GaitState, Goal, Stance};
use crate::knot::KNOT;
use crate::pattern_model::PatternModel;
use crate::proportions::PatternProportions;
use crate::step_adjustment::StepAdjustment;
use crate::step_choice::{StepChoice, StepProblem};

/// What a measurement shows of the balance of the robot, in support coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredBalance {
    /// The divergent component of motion (m).
    pub dcm: Vector2<f64>,
    /// The ZMP farthest back and to the right, and farthest ahead and to the left, that the support ankle can hold (m).
    pub zmp_bounds: [Vector2<f64>; 2],
}

/// Fewest knots until touchdown in which a step can still be changed.
const KNOTS_MIN: u32 = 5;
/// Latest touchdown that is considered (knots): a walk that is held at its beginning has none.
const KNOTS_MAX: f64 = 300.0;
/// Change of the touchdown that is worth another plan (knots).
const KNOTS_WORTH: u32 = 2;
/// Largest speed factor at which a half-step ends early, and how much faster than before that is at most.
const SPEED_MAX: f64 = 2.0;
const SPEED_UP_MAX: f64 = 1.0;
/// Peak of the speed of a quintic from rest to rest, over its mean.
const PEAK_OF_QUINTIC: f64 = 1.875;

impl FootTrajectory {
    /// Where and when the swing foot should land, if that is worth another plan; `None` also late in a half-step, and
    /// in a stand.
    ///
    /// * `landings` – where the swing foot lands, and the support foot after it
    /// * `knots` – until the plan can be changed
    /// * `lead` – knots from now until the changed plan is played
    pub(crate) fn choose_step(
        &self,
        model: &PatternModel,
        landings: &[WalkPose; 2],
        measured: &MeasuredBalance,
        [knots, lead]: [u32; 2],
    ) -> Option<StepChoice> {
        let problem = self.step_problem(model, landings, measured, [knots, lead])?;
        let choice = problem.solve();
        let is_worth = (choice.offset - problem.offset).amax() > model.proportions.step_adjustment_change_min
            || choice.knots.is_some_and(|knots| knots.abs_diff(problem.planned) >= KNOTS_WORTH);
        is_worth.then_some(choice)
    }

    /// What a step is chosen from; `None` late in a half-step, and in a stand. Parameters as for
    /// [`choose_step`](Self::choose_step).
    pub(crate) fn step_problem(
        &self,
        model: &PatternModel,
        landings: &[WalkPose; 2],
        measured: &MeasuredBalance,
        [knots, lead]: [u32; 2],
    ) -> Option<StepProblem> {
        let walk = &self.footsteps.walk;
        let speed = walk.speed().state().value;
        let nominal = walk.table().duration / KNOT;
        // At nominal speed.
        let left = (1.0 - walk.half_step().progress) * nominal - f64::from(knots) * speed;
        let planned = (left / speed).min(KNOTS_MAX);
        if self.footsteps.gait_state.is_standing() || planned < f64::from(KNOTS_MIN) {
            return None;
        }
        let fastest = (speed + SPEED_UP_MAX).min(SPEED_MAX);
        let proportions = &model.proportions;
        let planned = planned.round() as u32;
        Some(StepProblem {
            dcm: measured.dcm,
            dcm_at_touchdown: self.dcm_at_touchdown(model, landings),
            zmp: Vector2::new(0.0, model.mechanism.sole.centre(Side::Right).y),
            zmp_bounds: measured.zmp_bounds,
            growth: model.lipm_residual.growth_per_knot(),
            lead,
            planned,
            knots: [
                ((left / fastest).ceil() as u32).clamp(KNOTS_MIN, planned),
                ((left / self.footsteps.planned_speed()).min(KNOTS_MAX) as u32).max(planned),
            ],
            offset: self.adjustment.target(),
            offset_bounds: self.offset_bounds(model),
            offset_change_max: proportions.swing_speed_added_max * KNOT / PEAK_OF_QUINTIC,
            left_to_next_ankle: self.left_after_touchdown(model),
            cost_of_knot: proportions.offset_per_time * KNOT,
        })
    }

    /// Lets the swing foot land as chosen, as far as feet and legs allow. Returns whether that changed anything: in a
    /// stand, and once the sole is over its place, nothing changes.
    pub(crate) fn adjust_step(&mut self, model: &PatternModel, step: &StepChoice) -> bool {
        let progress = self.footsteps.walk.half_step().progress;
        if self.footsteps.gait_state.is_standing() || !StepAdjustment::is_in_time(progress) {
            return false;
        }
        let [least, most] = self.offset_bounds(model);
        let offset = step.offset.sup(&least).inf(&most);
        let landing = self.unadjusted_landing() + offset;
        let position = &mut self.footsteps.feet.landing.position;
        (position.x, position.y) = (landing.x, landing.y);
        if let Some(knots) = step.knots {
            self.footsteps.end_half_step_in(f64::from(knots) * KNOT);
        }
        self.adjustment.retarget(progress, offset);
        if let GaitState::Stopping { half_steps: 1, stance, goal } = &mut self.footsteps.gait_state
            && *stance == Stance::Parallel
        {
            // The feet do not land side by side: one more half-step will bring them there.
            *stance = Stance::Stride;
            if let Goal::Stand(_) = goal {
                *goal = Goal::Stand(Stance::Parallel);
            }
        }
        true
    }

    /// The error of the divergent component at touchdown that needs no step (m): what the next ankle corrects. Before a
    /// stand both feet carry the robot then.
    fn left_after_touchdown(&self, model: &PatternModel) -> Vector2<f64> {
        let to_ankle = model.proportions.dcm_error_left_to_next_ankle;
        match self.footsteps.gait_state {
            GaitState::Stopping { half_steps: 1, .. } => {
                to_ankle + Vector2::new(0.0, self.unadjusted_landing().y / 2.0)
            }
            _ => to_ankle,
        }
    }

    /// Where the swing foot would land without adjustment (m).
    fn unadjusted_landing(&self) -> Vector2<f64> {
        self.footsteps.feet.landing.position.xy() - self.adjustment.target()
    }

    /// The adjustments farthest back and to the right, and farthest ahead and to the left, that keep the soles apart
    /// and the legs within reach (m).
    fn offset_bounds(&self, model: &PatternModel) -> [Vector2<f64>; 2] {
        let planned = self.unadjusted_landing();
        let PatternProportions { step_ahead_max, step_back_max, step_aside_max, sole_spacing_min, .. } =
            model.proportions;
        let [least, most] =
            [Vector2::new(-step_back_max, sole_spacing_min), Vector2::new(step_ahead_max, step_aside_max)];
        [(least - planned).inf(&Vector2::zeros()), (most - planned).sup(&Vector2::zeros())]
    }

    /// Where the divergent component should be at a touchdown at the unadjusted place (m): so that the pendulum goes on
    /// over the coming footsteps, each as the one after this touchdown (Englsberger, Ott and Albu-Schäffer 2015).
    pub(crate) fn dcm_at_touchdown(&self, model: &PatternModel, landings: &[WalkPose; 2]) -> Vector2<f64> {
        let zmp = Vector2::new(0.0, model.mechanism.sole.centre(Side::Right).y);
        let turned = |yaw: f64, v: Vector2<f64>| (rotation_about_z(yaw) * Vector3::new(v.x, -v.y, 0.0)).xy();
        let side = self.footsteps.feet.footprint.side.other();
        let seen = pose_seen_from(&landings[0], &landings[1]);
        let yaw = side.lateral_sign() * seen.heading;
        // From ZMP to ZMP, in coordinates of the foot that has landed.
        let step = Vector2::new(seen.x, side.lateral_sign() * seen.y) + turned(yaw, zmp) - zmp;
        let knots = self.footsteps.walk.table().duration / self.footsteps.planned_speed() / KNOT;
        let shrinks = model.lipm_residual.growth_per_knot().powi(-(knots.round() as i32));
        let before = |later: Vector2<f64>| (step + turned(yaw, later)) * shrinks;
        let beyond = match self.footsteps.gait_state {
            // In a stand the ZMP is between the feet.
            GaitState::Stopping { half_steps: 1, .. } => step / 2.0,
            GaitState::Stopping { .. } => before(step / 2.0),
            _ => before(before(before(Vector2::zeros()))),
        };
        self.unadjusted_landing() + turned(self.footsteps.feet.landing.yaw, zmp + beyond)
    }
}
