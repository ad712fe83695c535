//! The state machine of the gait: walking, stepping in place, stopping, standing, starting.
//!
//! States change at the end of a half-step, when both soles are on the ground and at rest. `n` counts the half-steps
//! that begin until the state is left.
//!
//! A new goal changes the state at once ([`GaitState::set_goal`]). "Same" keeps the state, "then" keeps it too and
//! reaches the goal after it:
//!
//! | state              | `Walk`     | `InPlace`    | `Stand(stance)`         |
//! |--------------------|------------|--------------|-------------------------|
//! | `Walking`          | same       | `InPlace(1)` | `Stopping(2, stance)`   |
//! | `InPlace(1)`       | `Walking`  | same         | `Stopping(2, stance)`   |
//! | `InPlace(0)`       | `Walking`  | same         | `Stopping(1, Parallel)` |
//! | `Stopping(2)`      | `Walking`  | `InPlace(1)` | `Stopping(2, stance)`   |
//! | `Stopping(1)`      | then       | then         | then                    |
//! | `Standing`         | `Starting` | `Starting`   | same (*)                |
//! | `Starting`         | then       | then         | `Returning` (*)         |
//! | `Returning`        | `Starting` | `Starting`   | same (*)                |
//!
//! (*) From a stand in stride to a parallel one the robot starts: it needs one more half-step.
//!
//! The rest happens as time passes ([`GaitState::advance`]):
//!
//! | state                     | event                 | next state                             |
//! |---------------------------|-----------------------|----------------------------------------|
//! | `InPlace(1)`              | a half-step begins    | `InPlace(0)`                           |
//! | `Stopping(2)`             | a half-step begins    | `Stopping(1)`                          |
//! | `Stopping(1)`             | a half-step begins    | `Standing`, which gets the goal `then` |
//! | `Starting` to `Walk`      | the weight is shifted | `Walking`                              |
//! | `Starting` to `InPlace`   | the weight is shifted | `InPlace(0)`                           |
//! | `Starting` to `Stand`     | the weight is shifted | `Stopping(1)`                          |
//! | `Returning`               | the weight is back    | `Standing`                             |

use gait::Walk;
use signal::smooth_step;

use crate::knot::KNOT;

/// The gait that is commanded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// Half-step after half-step.
    Walk,
    /// Half-steps without advance, the feet side by side after each.
    InPlace,
    /// A stand.
    Stand(Stance),
}

/// The position of the feet in a stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stance {
    /// As they landed, one ahead of the other.
    Stride,
    /// Side by side.
    Parallel,
}

/// The state of the gait; see the tables in the head of this file for its transitions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GaitState {
    /// Half-step follows half-step.
    Walking,
    /// Half-steps follow each other without advance.
    InPlace {
        /// Half-steps that begin until one lands with the feet side by side; 0 from then on.
        half_steps: u8,
    },
    /// The last half-steps before a stand.
    Stopping {
        /// Half-steps that begin until the robot stands; the stand itself counts as one.
        half_steps: u8,
        /// The position of the feet in that stand.
        stance: Stance,
        /// The goal that follows the stand.
        goal: Goal,
    },
    /// Standing on both feet.
    Standing(Stance),
    /// In a stand, the weight shifts onto the first support foot.
    Starting {
        /// The position of the feet.
        stance: Stance,
        /// Knots until the weight is shifted.
        knots_left: u32,
        /// The goal that follows.
        goal: Goal,
    },
    /// A start was taken back: the weight returns to both feet.
    Returning {
        /// The position of the feet.
        stance: Stance,
        /// Knots until the weight would be shifted; all of them when it is back.
        knots_left: u32,
    },
}

/// The half-step in which a stop is commanded ends unchanged; the next one is the last.
const HALF_STEPS_TO_STAND: u8 = 2;
/// Duration of the weight shift from both feet to one: 0.8 s, more than two time constants of the pendulum.
const WEIGHT_SHIFT_KNOTS: u32 = 80;

impl GaitState {
    /// Commands another goal. Once the last half-step before a stand has begun, the goal follows the stand.
    pub fn set_goal(&mut self, goal: Goal) {
        use GaitState::*;
        let start = |stance, knots_left| Starting { stance, knots_left, goal };
        *self = match (*self, goal) {
            (Stopping { half_steps: 1, stance, .. }, _) => Stopping { half_steps: 1, stance, goal },
            // In place the feet are side by side already.
            (InPlace { half_steps: 0 }, Goal::Stand(_)) => Stopping { half_steps: 1, stance: Stance::Parallel, goal },
            (Walking | InPlace { .. } | Stopping { .. }, Goal::Stand(stance)) => {
                Stopping { half_steps: self.half_steps_remaining().unwrap_or(HALF_STEPS_TO_STAND), stance, goal }
            }
            (Walking | InPlace { .. } | Stopping { .. }, Goal::Walk) => Walking,
            (in_place @ InPlace { .. }, Goal::InPlace) => in_place,
            (Walking | Stopping { .. }, Goal::InPlace) => {
                InPlace { half_steps: self.half_steps_remaining().unwrap_or(HALF_STEPS_TO_STAND) - 1 }
            }
            (Standing(Stance::Stride), Goal::Stand(Stance::Parallel)) => start(Stance::Stride, WEIGHT_SHIFT_KNOTS),
            (
                Starting { stance: Stance::Stride, knots_left, .. } | Returning { stance: Stance::Stride, knots_left },
                Goal::Stand(Stance::Parallel),
            ) => start(Stance::Stride, knots_left),
            (Standing(stance), Goal::Stand(_)) => Standing(stance),
            (Starting { stance, knots_left, .. } | Returning { stance, knots_left }, Goal::Stand(_)) => {
                Returning { stance, knots_left }
            }
            (Standing(stance), _) => start(stance, WEIGHT_SHIFT_KNOTS),
            (Starting { stance, knots_left, .. } | Returning { stance, knots_left }, _) => start(stance, knots_left),
        };
    }

    /// Lets a walk follow the stand that lies ahead, if one does.
    pub fn walk_after_stand(&mut self) {
        if let GaitState::Stopping { goal, .. } = self {
            *goal = Goal::Walk;
        }
    }

    /// Half-steps that begin until the feet are side by side or the robot stands, if one of these lies ahead.
    fn half_steps_remaining(self) -> Option<u8> {
        match self {
            GaitState::InPlace { half_steps } => Some(half_steps + 1),
            GaitState::Stopping { half_steps, .. } => Some(half_steps),
            GaitState::Walking | GaitState::Standing(_) | GaitState::Starting { .. } | GaitState::Returning { .. } => {
                None
            }
        }
    }

    /// Half-steps that begin until the gait does what is commanded; 0 when it does.
    pub fn half_steps_to_goal(self) -> u8 {
        match self {
            GaitState::InPlace { half_steps } | GaitState::Stopping { half_steps, .. } => half_steps,
            GaitState::Walking | GaitState::Standing(_) | GaitState::Starting { .. } | GaitState::Returning { .. } => 0,
        }
    }

    /// Whether half-step follows half-step, with no stand ahead.
    pub fn is_stepping(self) -> bool {
        matches!(self, GaitState::Walking | GaitState::InPlace { .. })
    }

    /// Whether the robot stands on both feet.
    pub fn is_standing(self) -> bool {
        matches!(self, GaitState::Standing(_) | GaitState::Starting { .. } | GaitState::Returning { .. })
    }

    /// Advances by a knot, and `walk` with it unless the robot stands. Returns whether a half-step began.
    pub fn advance(&mut self, walk: &mut Walk) -> bool {
        use GaitState::*;
        let begins = !self.is_standing() && walk.advance(KNOT);
        *self = match *self {
            InPlace { half_steps } if begins => InPlace { half_steps: half_steps.saturating_sub(1) },
            Stopping { half_steps: half_steps @ 2.., stance, goal } if begins => {
                Stopping { half_steps: half_steps - 1, stance, goal }
            }
            Stopping { stance, goal, .. } if begins => {
                let mut stand = Standing(stance);
                stand.set_goal(goal);
                stand
            }
            Starting { stance, knots_left: knots_left @ 2.., goal } => {
                Starting { stance, knots_left: knots_left - 1, goal }
            }
            Returning { stance, knots_left } if knots_left + 1 < WEIGHT_SHIFT_KNOTS => {
                Returning { stance, knots_left: knots_left + 1 }
            }
            Returning { stance, .. } => Standing(stance),
            Starting { goal: Goal::Walk, .. } => Walking,
            Starting { goal: Goal::InPlace, .. } => InPlace { half_steps: 0 },
            Starting { goal: goal @ Goal::Stand(stance), .. } => Stopping { half_steps: 1, stance, goal },
            same => same,
        };
        begins
    }

    /// Share of the weight on the support foot: 0.5 in a stand, 1 while walking.
    pub fn support_weight_share(self) -> f64 {
        match self {
            GaitState::Standing(_) => 0.5,
            GaitState::Starting { .. } | GaitState::Returning { .. } => {
                0.5 + 0.5 * smooth_step(self.weight_shift_progress())
            }
            _ => 1.0,
        }
    }

    /// Progress of the weight shift, linear in time: 0 in a stand, 1 while walking.
    pub fn weight_shift_progress(self) -> f64 {
        match self {
            GaitState::Standing(_) => 0.0,
            GaitState::Starting { knots_left, .. } | GaitState::Returning { knots_left, .. } => {
                1.0 - f64::from(knots_left) / f64::from(WEIGHT_SHIFT_KNOTS)
            }
            _ => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use GaitState::*;

    const STAND: Goal = Goal::Stand(Stance::Parallel);

    fn after(mut state: GaitState, goal: Goal) -> GaitState {
        state.set_goal(goal);
        state
    }

    fn stopping(half_steps: u8, stance: Stance, goal: Goal) -> GaitState {
        Stopping { half_steps, stance, goal }
    }

    #[test]
    fn goals_change_a_gait_in_motion_as_the_table_says() {
        use Goal::{InPlace as OnTheSpot, Stand, Walk};
        use Stance::{Parallel, Stride};
        let [in_place, on_the_spot] = [InPlace { half_steps: 1 }, InPlace { half_steps: 0 }];
        for stance in [Stride, Parallel] {
            let stand = Stand(stance);
            for (state, walk, step, stop) in [
                (Walking, Walking, in_place, stopping(2, stance, stand)),
                (in_place, Walking, in_place, stopping(2, stance, stand)),
                (on_the_spot, Walking, on_the_spot, stopping(1, Parallel, stand)),
                (stopping(2, Stride, Stand(Stride)), Walking, in_place, stopping(2, stance, stand)),
            ] {
                let found = [Walk, OnTheSpot, stand].map(|goal| after(state, goal));
                assert_eq!(found, [walk, step, stop], "from {state:?}");
            }
        }
    }

    #[test]
    fn last_half_step_before_a_stand_is_not_changed() {
        for goal in [Goal::Walk, Goal::InPlace, Goal::Stand(Stance::Stride)] {
            let last = stopping(1, Stance::Parallel, STAND);
            assert_eq!(after(last, goal), stopping(1, Stance::Parallel, goal));
        }
    }

    #[test]
    fn stand_in_stride_becomes_parallel_by_one_more_half_step() {
        let mut state = after(Standing(Stance::Stride), STAND);
        assert_eq!(state, Starting { stance: Stance::Stride, knots_left: WEIGHT_SHIFT_KNOTS, goal: STAND });
        assert_eq!(after(state, STAND), state, "the weight shift does not begin anew");
        state = after(Standing(Stance::Parallel), STAND);
        assert_eq!(state, Standing(Stance::Parallel), "the feet are so already");
    }

    #[test]
    fn start_that_is_taken_back_returns_by_the_way_it_came() {
        let knots_left = WEIGHT_SHIFT_KNOTS - 3;
        let starting = Starting { stance: Stance::Parallel, knots_left, goal: Goal::Walk };
        let returning = after(starting, STAND);
        assert_eq!(returning.support_weight_share(), starting.support_weight_share(), "nothing jumps");
        assert_eq!(after(returning, Goal::Walk), starting, "and it may start again");
        let last = Returning { stance: Stance::Parallel, knots_left: WEIGHT_SHIFT_KNOTS - 1 };
        assert!(last.support_weight_share() - 0.5 < 1e-3, "then it stands");
    }

    #[test]
    fn weight_shifts_from_both_feet_to_one() {
        let start = Starting { stance: Stance::Parallel, knots_left: WEIGHT_SHIFT_KNOTS / 2, goal: Goal::Walk };
        assert_eq!(Standing(Stance::Parallel).support_weight_share(), 0.5);
        assert_eq!(start.support_weight_share(), 0.75);
        assert_eq!(Walking.support_weight_share(), 1.0);
    }
}
