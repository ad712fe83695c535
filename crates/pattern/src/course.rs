//! The course of a walk to a destination: which footstep comes next.
//!
//! Places are given in the frame in which odometry estimates where the robot is. The feet of a plan stand in the plan's
//! own walk frame. The plan knows where the one is in the other, and is told anew as the robot walks: so it corrects
//! what slips and yields.

use dynamics::{pose_seen_from, poses_in_frame_of};
use interface::{Footstep, PlaceList, Places, WalkPose, Waypoint};

use crate::feet::Feet;
use crate::footprint::{SolePose, within_half_turn};
use crate::gait_state::Stance;
use crate::pattern_model::PatternModel;
use crate::step_bounds::{Approach, GoalPose, StepBounds};

/// A walk to a destination.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    places: Places,
    /// The frame of the places, in the walk frame of the plan.
    frame: WalkPose,
    /// How many places the footsteps have reached, the one in the making included.
    reached: usize,
    /// How the robot walks to the next way-point.
    approach: Option<Approach>,
    bounds: StepBounds,
    /// Half-steps made near the goal.
    half_steps_near: u32,
}

/// A half-step of a course.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CourseStep {
    /// Where the swing foot lands, in support coordinates.
    pub landing: SolePose,
    /// The stand that follows it, if it is the last one.
    pub stance: Option<Stance>,
}

/// How near to the goal the robot comes to a stand (m), and how near to its heading (rad). Each half-step
/// within [`NEAR`] of the goal adds as much again, up to [`ARRIVED_TIMES_MAX`] times: where soles slip or yield, the
/// robot would never stop stepping.
const ARRIVED: f64 = 0.004;
const ARRIVED_TURN: f64 = 0.008;
const ARRIVED_TIMES_MAX: u32 = 4;
/// Near the goal: as a share of the largest half-step.
const NEAR: f64 = 0.1;
/// How near a way-point is passed, as a share of the largest half-step, and how near to its heading (rad).
const PASSED: f64 = 0.6;
const PASSED_TURN: f64 = 0.17;

impl Course {
    /// A course to places.
    ///
    /// * `frame` – of the places, in the walk frame of the plan
    pub(crate) fn new(places: &Places, frame: WalkPose, bounds: StepBounds) -> Self {
        Self { places: *places, frame, reached: 0, approach: None, bounds, half_steps_near: 0 }
    }

    /// The places.
    pub(crate) fn places(&self) -> &Places {
        &self.places
    }

    /// How many places the footsteps have not reached.
    pub(crate) fn places_left(&self) -> usize {
        self.places.count() - self.reached
    }

    /// The frame of the places, in the walk frame of the plan.
    pub(crate) fn frame(&self) -> &WalkPose {
        &self.frame
    }

    /// Corrects the frame of the places.
    pub(crate) fn set_frame(&mut self, frame: WalkPose) {
        self.frame = frame;
    }

    /// The half-step that begins; `None` once all places are reached.
    ///
    /// * `feet` – the support foot and the one that is to swing
    pub(crate) fn next_step(&mut self, model: &PatternModel, feet: &Feet) -> Option<CourseStep> {
        if self.places_left() == 0 {
            return None;
        }
        Some(match self.places {
            Places::Waypoints(waypoints) => self.step_to_waypoints(&waypoints, model, feet),
            Places::Footsteps(footsteps) => self.next_footstep(&footsteps, feet),
        })
    }

    /// The next of given footsteps. If the other foot is to swing first, this one steps in place.
    fn next_footstep(&mut self, footsteps: &PlaceList<Footstep>, feet: &Feet) -> CourseStep {
        let Footstep { side, sole } = footsteps[self.reached];
        if side == feet.footprint.side {
            return CourseStep { landing: feet.lift_off, stance: None };
        }
        self.reached += 1;
        let [sole] = poses_in_frame_of(&self.frame, &[sole]);
        let is_last = self.places_left() == 0;
        CourseStep { landing: feet.footprint.sole_at(&sole), stance: is_last.then_some(Stance::Stride) }
    }

    fn step_to_waypoints(&mut self, waypoints: &PlaceList<Waypoint>, model: &PatternModel, feet: &Feet) -> CourseStep {
        // The middle between the feet, as either foot has it with the other one beside it.
        let lead = feet.footprint.side.lateral_sign();
        let beside = WalkPose { y: 0.5 * lead * model.mechanism.foot_distance(), ..WalkPose::default() };
        let [now] = poses_in_frame_of(&feet.footprint.pose(), &[beside]);
        let other = feet.footprint.next(&feet.lift_off).pose();
        let [before] = poses_in_frame_of(&other, &[WalkPose { y: -beside.y, ..beside }]);
        let last = pose_seen_from(&before, &now);

        let seen = |waypoint: &Waypoint| {
            let pose = WalkPose { x: waypoint.x, y: waypoint.y, heading: waypoint.heading.unwrap_or(0.0) };
            let [pose] = poses_in_frame_of(&self.frame, &[pose]);
            let WalkPose { x, y, heading } = pose_seen_from(&now, &pose);
            GoalPose { x, y, turn: waypoint.heading.map(|_| within_half_turn(heading)) }
        };
        let is_near = |waypoint: &Waypoint, distance: f64, turn: f64| {
            let goal = seen(waypoint);
            goal.turn.is_none_or(|left| left.abs() <= turn) && goal.x * goal.x + goal.y * goal.y <= distance * distance
        };
        let goal = waypoints.len() - 1;
        let passed = |waypoint: &Waypoint| is_near(waypoint, PASSED * self.bounds.ahead, PASSED_TURN);
        let reached = self.reached + waypoints[self.reached..goal].iter().take_while(|&place| passed(place)).count();
        let enough = 1.0 + f64::from(self.half_steps_near.min(ARRIVED_TIMES_MAX - 1));
        let arrives = reached == goal && is_near(&waypoints[goal], enough * ARRIVED, enough * ARRIVED_TURN);
        let is_close = reached == goal && is_near(&waypoints[goal], NEAR * self.bounds.ahead, PASSED_TURN);
        let step = if arrives {
            WalkPose::default()
        } else {
            let (goal, before) = (seen(&waypoints[reached]), self.approach.filter(|_| reached == self.reached));
            let approach = self.bounds.approach_to(&goal, before);
            self.approach = Some(approach);
            self.bounds.towards(&goal, approach, lead, &last)
        };
        let [sole] = poses_in_frame_of(&now, &[step]);
        let [sole] = poses_in_frame_of(&sole, &[beside]);
        self.half_steps_near += u32::from(is_close);
        self.reached = if arrives { waypoints.len() } else { reached };
        let landing = model.velocity.geometry().spacing().kept(&feet.footprint.sole_at(&sole));
        CourseStep { landing, stance: arrives.then_some(Stance::Parallel) }
    }
}
