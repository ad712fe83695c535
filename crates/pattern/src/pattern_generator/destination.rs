//! Walks to a destination: where its places are in the plan, and how far the walk has come.

use dynamics::{pose_seen_from, poses_in_frame_of};
use interface::{Footstep, Places, SteadyWalk, WalkPose};

use super::PatternGenerator;
use crate::course::Course;
use crate::footprint::within_half_turn;
use crate::footstep_check::{FootstepFault, check_footsteps};
use crate::gait::Gait;
use crate::gait_state::GaitState;
use crate::incremental_replan::PlanChange;
use crate::step_bounds::StepBounds;

/// Progress in which the way to a destination is corrected: the support sole lies flat, and the next landing is not
/// planned in detail yet.
const LOCATED: std::ops::Range<f64> = 0.15..0.6;
/// Least displacement (m) and rotation (rad) of the support sole against the plan that is worth another plan.
const DISPLACEMENT_MIN: f64 = 5e-4;
const ROTATION_MIN: f64 = 1e-3;

/// How a robot sets out for a destination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// Share of the largest half-steps to way-points; less is easier (-).
    pub share: f64,
    /// Whether it comes to a stand first.
    pub stops_first: bool,
}

impl PatternGenerator {
    /// Walks to a destination, from the next half-step on, and plans it at once.
    ///
    /// * `support_sole` – where the sole of the present support foot is in the frame of the places
    /// * `speed` – the speed factor
    pub fn walk_to(&mut self, places: &Places, support_sole: &WalkPose, speed: f64, departure: Departure) {
        let bounds = StepBounds::new(&self.model, self.walk().limits(), departure.share);
        let course = Course::new(places, self.frame_of_places(support_sole), bounds);
        self.plan.follow(&self.model, course, speed, departure.stops_first);
    }

    /// The walk of the largest half-steps to way-points, each alone.
    pub fn walk_to_waypoints(&self, speed: f64, share: f64) -> SteadyWalk {
        StepBounds::new(&self.model, self.walk().limits(), share).walk(self.walk().table().duration / speed)
    }

    /// Checks footsteps against the range of steps, each seen from the one before.
    ///
    /// * `support_sole` – where the sole of the present support foot is in the frame of the footsteps
    ///
    /// # Errors
    /// The first one that cannot be made.
    pub fn check_footsteps(&self, footsteps: &[Footstep], support_sole: &WalkPose) -> Result<(), FootstepFault> {
        let frame = self.frame_of_places(support_sole);
        check_footsteps(&self.model, self.plan.footsteps(), footsteps, &frame)
    }

    /// Corrects the way to a destination, if the robot walks to one, once in each half-step.
    ///
    /// * `support_sole` – where the sole of the present support foot is in the frame of the places
    pub fn locate(&mut self, support_sole: &WalkPose) {
        let now = self.half_step();
        let Some(course) = self.plan.footsteps().course() else { return };
        let is_due = self.execution.located_in != Some(now.index) && LOCATED.contains(&now.progress);
        if !is_due || self.gait_state() != GaitState::Walking || self.walk().half_step().index != now.index {
            return;
        }
        self.execution.located_in = Some(now.index);
        let [expected] = poses_in_frame_of(course.frame(), &[*support_sole]);
        let WalkPose { x, y, heading } = pose_seen_from(&self.footprint().pose(), &expected);
        if x.abs().max(y.abs()) > DISPLACEMENT_MIN || within_half_turn(heading).abs() > ROTATION_MIN {
            let course_frame = Some(self.frame_of_places(support_sole));
            self.replan_soon(PlanChange { course_frame, ..PlanChange::default() });
        }
    }

    /// The destination, and how many of its places are still to be reached, if the robot walks to one or has arrived.
    pub fn destination(&self) -> Option<(&Places, usize)> {
        let course = self.plan.footsteps().course()?;
        let stands = matches!(self.gait_state(), GaitState::Standing(_));
        let left = if stands { course.places_left() } else { course.places_left().max(1) };
        Some((course.places(), left))
    }

    /// Whether the robot stands at its destination.
    pub fn has_arrived(&self) -> bool {
        self.destination().is_some_and(|(_, left)| left == 0)
    }

    /// Where the frame is, in the walk frame, in which the present support sole is at `support_sole`.
    fn frame_of_places(&self, support_sole: &WalkPose) -> WalkPose {
        let origin = pose_seen_from(support_sole, &WalkPose::default());
        let [frame] = poses_in_frame_of(&self.footprint().pose(), &[origin]);
        frame
    }
}
