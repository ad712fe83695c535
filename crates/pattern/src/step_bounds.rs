//! How far a half-step of a walk to a goal may go, and in how many half-steps it gets there.

use dynamics::{atan2, pose_seen_from};
use gait::Limits;
use interface::{SteadyWalk, WalkPose, WalkVelocity};

use crate::footprint::within_half_turn;
use crate::pattern_model::PatternModel;

/// The largest half-steps of a walk to a goal. Together they are an ellipsoid: who goes far does not turn far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StepBounds {
    /// Ahead (m).
    pub ahead: f64,
    /// Back (m).
    pub back: f64,
    /// To the side of the swinging foot (m).
    pub aside: f64,
    /// To the side of the swinging foot (rad).
    pub turn: f64,
}

/// A goal, seen from the middle between the feet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GoalPose {
    /// Ahead (m).
    pub x: f64,
    /// To the left (m).
    pub y: f64,
    /// How far to turn (rad), within ±π; `None` if any heading will do.
    pub turn: Option<f64>,
}

/// How a robot walks to a goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Approach {
    /// Ahead, back, aside and turning at once.
    Straight,
    /// Turning towards the goal, ahead, and turning there.
    Facing,
}

/// How short the other approach must be for a robot to leave the straight one, as a share of that: so they never
/// alternate.
const SHARE_TO_LEAVE: f64 = 0.7;
/// Shares of the configured range: the rest is left for balance.
const SHARE_OF_SIDESTEP: f64 = 0.75;
const SHARE_OF_TURN: f64 = 0.7;
/// Back, as a share of ahead.
const SHARE_BACK: f64 = 0.6;
/// Least bound, as a share of the nominal step (or of a radian): a robot that may not sidestep must correct its place.
const SHARE_MIN: f64 = 0.02;
/// Largest change of the way ahead from one half-step to the next, as a share of the nominal step.
const SHARE_OF_CHANGE: f64 = 0.75;
/// Heading error (rad) from which on a robot turns in place.
const TURN_IN_PLACE: f64 = 0.7;
/// What a foot may give way inward: across, as a share of the largest half-step, and in heading (rad). That corrects a
/// place without another full step.
const INWARD: f64 = 0.02;
const INWARD_TURN: f64 = 0.02;

impl StepBounds {
    /// For a robot with the configured range of gait parameters.
    ///
    /// * `share` – of the largest half-steps; less is easier (-)
    pub(crate) fn new(model: &PatternModel, limits: &Limits, share: f64) -> Self {
        let geometry = model.velocity.geometry();
        let nominal = geometry.step(0.0);
        let least = SHARE_MIN * nominal;
        let back = (-geometry.step(0.5 * limits.extension_min)).min(SHARE_BACK * nominal);
        let aside = geometry.aside(0.5 * SHARE_OF_SIDESTEP * limits.sidestep_max, 0.0);
        Self {
            ahead: share * nominal,
            back: (share * back).max(least),
            aside: (share * aside).max(least),
            turn: (share * SHARE_OF_TURN * limits.turn_max).max(SHARE_MIN),
        }
    }

    /// The walk that these half-steps come to, each alone.
    ///
    /// * `half_step` – duration of a half-step (s)
    pub(crate) fn walk(&self, half_step: f64) -> SteadyWalk {
        let velocity = WalkVelocity {
            ahead: self.ahead / half_step,
            left: self.aside / (2.0 * half_step),
            turn: self.turn / (2.0 * half_step),
        };
        SteadyWalk { step_ahead: self.ahead, step_aside: self.aside, velocity }
    }

    /// Which approach takes fewer half-steps to a goal.
    ///
    /// * `goal` – seen from the middle between the feet
    /// * `before` – the approach so far: the straight one is left only for one that is much shorter
    pub(crate) fn approach_to(&self, goal: &GoalPose, before: Option<Approach>) -> Approach {
        let distance = (goal.x * goal.x + goal.y * goal.y).sqrt();
        let bearing = atan2(goal.y, goal.x);
        let turn_after = goal.turn.map_or(0.0, |turn| within_half_turn(turn - bearing));
        let facing = distance / self.ahead + 2.0 * (bearing.abs() + turn_after.abs()) / self.turn;
        let straight = self.half_steps(goal);
        let share = if before == Some(Approach::Straight) { SHARE_TO_LEAVE } else { 1.0 };
        if facing < share * straight { Approach::Facing } else { Approach::Straight }
    }

    /// The next half-step to a goal: what it moves the middle between the feet, in the frame of that middle before it.
    ///
    /// * `goal` – seen from the middle between the feet
    /// * `lead` – 1 if the left foot swings, −1 if the right one does
    /// * `last` – what the half-step before has moved
    pub(crate) fn towards(&self, goal: &GoalPose, approach: Approach, lead: f64, last: &WalkPose) -> WalkPose {
        let wish = match approach {
            Approach::Straight => WalkPose { x: goal.x, y: goal.y, heading: goal.turn.unwrap_or(0.0) },
            Approach::Facing => {
                let bearing = atan2(goal.y, goal.x);
                let share = (1.0 - bearing.abs() / TURN_IN_PLACE).max(0.0);
                WalkPose { x: share * goal.x, y: 0.0, heading: bearing }
            }
        };
        self.within(&wish, lead, last)
    }

    /// About how many half-steps take the robot straight to a goal. It turns in proportion to the way, so that all
    /// headings between count alike: their mean by Simpson's rule. Only every other half-step goes to a given side.
    fn half_steps(&self, goal: &GoalPose) -> f64 {
        let turn = goal.turn.unwrap_or(0.0);
        let to_turn = 2.0 * turn / self.turn;
        let facing = |heading: f64| {
            let here = WalkPose { heading, ..WalkPose::default() };
            let WalkPose { x, y, .. } = pose_seen_from(&here, &WalkPose { x: goal.x, y: goal.y, heading: 0.0 });
            let along = x / if x < 0.0 { self.back } else { self.ahead };
            let aside = 2.0 * y / self.aside;
            (along * along + aside * aside + to_turn * to_turn).sqrt()
        };
        (facing(0.0) + 4.0 * facing(0.5 * turn) + facing(turn)) / 6.0
    }

    /// The part of a wish that the next half-step makes.
    fn within(&self, wish: &WalkPose, lead: f64, last: &WalkPose) -> WalkPose {
        // Outward with the foot that leads there; inward only what is nearly nothing.
        let outward = |value: f64, inward: f64| if lead * value < -inward { 0.0 } else { value };
        let change = SHARE_OF_CHANGE * self.ahead;
        let stoppable = stoppable(wish.x.abs(), change).copysign(wish.x);
        let x = stoppable.clamp(last.x - change, last.x + change);
        let step = WalkPose { x, y: outward(wish.y, INWARD * self.ahead), heading: outward(wish.heading, INWARD_TURN) };
        let along = if step.x < 0.0 { step.x / self.back } else { step.x / self.ahead };
        let (aside, turn) = (step.y / self.aside, step.heading / self.turn);
        let size = (along * along + aside * aside + turn * turn).sqrt().max(1.0);
        WalkPose { x: step.x / size, y: step.y / size, heading: step.heading / size }
    }
}

/// The longest half-step from which a robot comes to rest within a distance, shortening each by `change` (m).
fn stoppable(distance: f64, change: f64) -> f64 {
    if distance <= change {
        return distance;
    }
    (0.25 * change * change + 2.0 * change * distance).sqrt() - 0.5 * change
}

#[cfg(test)]
mod tests {
    use dynamics::poses_in_frame_of;
    use proptest::prelude::*;

    use super::*;

    const BOUNDS: StepBounds = StepBounds { ahead: 0.34, back: 0.2, aside: 0.17, turn: 0.56 };
    const NEAR: f64 = 1e-3;

    /// The half-steps to a goal, each as it moves the middle between the feet.
    fn steps_to(goal: &WalkPose, any_heading: bool, mut lead: f64) -> Vec<WalkPose> {
        let (mut now, mut last, mut way) = (WalkPose::default(), WalkPose::default(), None);
        let mut steps = Vec::new();
        while steps.len() < 300 {
            let WalkPose { x, y, heading } = pose_seen_from(&now, goal);
            let seen = GoalPose { x, y, turn: (!any_heading).then(|| within_half_turn(heading)) };
            if x.hypot(y) < NEAR && seen.turn.is_none_or(|turn| turn.abs() < NEAR) {
                break;
            }
            way = Some(BOUNDS.approach_to(&seen, way));
            last = BOUNDS.towards(&seen, way.unwrap_or(Approach::Straight), lead, &last);
            [now] = poses_in_frame_of(&now, &[last]);
            steps.push(last);
            lead = -lead;
        }
        steps
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        /// The oracle: walking there by turning, walking ahead and turning, one after the other.
        #[test]
        fn every_goal_is_reached_in_about_as_many_half_steps_as_one_thing_after_the_other_takes(
            x in -6.0..6.0, y in -6.0..6.0, heading in -3.2..3.2, any_heading: bool, left: bool,
        ) {
            let goal = WalkPose { x, y, heading };
            let steps = steps_to(&goal, any_heading, if left { 1.0 } else { -1.0 });
            let (distance, bearing) = (x.hypot(y), y.atan2(x));
            let turns = bearing.abs() + if any_heading { 0.0 } else { within_half_turn(heading - bearing).abs() };
            let in_turn = distance / BOUNDS.ahead + 2.0 * turns / BOUNDS.turn;
            prop_assert!((steps.len() as f64) < 1.35 * in_turn + 8.0, "{} half-steps, {in_turn}", steps.len());
        }

        #[test]
        fn no_half_step_is_out_of_bounds_or_leads_with_the_wrong_foot(
            x in -3.0..3.0, y in -3.0..3.0, heading in -3.2..3.2, left: bool,
        ) {
            let mut lead = if left { 1.0 } else { -1.0 };
            let mut last = WalkPose::default();
            for step in steps_to(&WalkPose { x, y, heading }, false, lead) {
                let along = step.x / if step.x < 0.0 { BOUNDS.back } else { BOUNDS.ahead };
                let size = along.hypot(step.y / BOUNDS.aside).hypot(step.heading / BOUNDS.turn);
                prop_assert!(size < 1.0 + 1e-9, "{step:?}");
                let [aside, turn] = [lead * step.y, lead * step.heading];
                prop_assert!(aside >= -INWARD * BOUNDS.ahead - 1e-12 && turn >= -INWARD_TURN - 1e-12);
                // It may brake as hard as it likes.
                let grown = step.x.abs() - last.x.abs();
                prop_assert!(grown <= SHARE_OF_CHANGE * BOUNDS.ahead + 1e-9, "{last:?} {step:?}");
                (last, lead) = (step, -lead);
            }
        }
    }

    #[test]
    fn a_robot_walks_ahead_to_a_far_goal_and_aside_to_a_near_one() {
        let way = |x, y, turn| BOUNDS.approach_to(&GoalPose { x, y, turn: Some(turn) }, None);
        assert_eq!(way(0.0, 3.0, 0.0), Approach::Facing);
        assert_eq!(way(0.0, 0.3, 0.0), Approach::Straight);
        assert_eq!(way(-0.4, 0.0, 0.0), Approach::Straight);
        assert_eq!(way(3.0, 0.0, 1.5), Approach::Facing);
        assert_eq!(way(2.0, 0.1, 0.0), Approach::Straight);
    }
}
