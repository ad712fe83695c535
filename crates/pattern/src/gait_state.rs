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
//! | `Settling`         | then       | then         | then                    |
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
//! | … if it cannot stand on one foot |                | `Settling`                             |
//! | `Settling`                | the weight is at rest | `Standing`, which gets the goal `then` |
//! | `Starting` to `Walk`      | the weight is shifted | `Walking`                              |
//! | `Starting` to `InPlace`   | the weight is shifted | `InPlace(0)`                           |
//! | `Starting` to `Stand`     | the weight is shifted | `Stopping(1)`                          |
//! | `Returning`               | the weight is back    | `Standing`                             |

use gait::Walk;

use crate::knot::KNOT;
use crate::weight_shift::WeightShift;

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
    /// The last half-step has landed; the weight comes to rest on both feet.
    Settling {
        /// The position of the feet.
        stance: Stance,
        /// How far the weight has come.
        shift: WeightShift,
        /// The goal that follows the stand.
        goal: Goal,
    },
    /// Standing on both feet.
    Standing(Stance),
    /// In a stand, the weight shifts onto the first support foot.
    Starting {
        /// The position of the feet.
        stance: Stance,
        /// How far the weight is shifted.
        shift: WeightShift,
        /// The goal that follows.
        goal: Goal,
    },
    /// A start was taken back: the weight returns to both feet.
    Returning {
        /// The position of the feet.
        stance: Stance,
        /// How far the weight is shifted; not at all when it is back.
        shift: WeightShift,
    },
}

/// The half-step in which a stop is commanded ends unchanged; the next one is the last.
const HALF_STEPS_TO_STAND: u8 = 2;

impl GaitState {
    /// Commands another goal. Once the last half-step before a stand has begun, the goal follows the stand.
    ///
    /// * `whole` – the weight shift of the robot, with which it starts from a stand
    pub(crate) fn set_goal(&mut self, goal: Goal, whole: WeightShift) {
        use GaitState::*;
        let start = |stance, shift| Starting { stance, shift, goal };
        *self = match (*self, goal) {
            (Settling { stance, shift, .. }, _) => Settling { stance, shift, goal },
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
            (Standing(Stance::Stride), Goal::Stand(Stance::Parallel)) => start(Stance::Stride, whole),
            (
                Starting { stance: Stance::Stride, shift, .. } | Returning { stance: Stance::Stride, shift },
                Goal::Stand(Stance::Parallel),
            ) => start(Stance::Stride, shift),
            (Standing(stance), Goal::Stand(_)) => Standing(stance),
            (Starting { stance, shift, .. } | Returning { stance, shift }, Goal::Stand(_)) => {
                Returning { stance, shift }
            }
            (Standing(stance), _) => start(stance, whole),
            (Starting { stance, shift, .. } | Returning { stance, shift }, _) => start(stance, shift),
        };
    }

    /// Lets a walk follow the stand that lies ahead, if one does.
    pub fn walk_after_stand(&mut self) {
        if let GaitState::Stopping { goal, .. } | GaitState::Settling { goal, .. } = self {
            *goal = Goal::Walk;
        }
    }

    /// The state with another goal; see [`set_goal`](Self::set_goal).
    fn with_goal(mut self, goal: Goal, whole: WeightShift) -> Self {
        self.set_goal(goal, whole);
        self
    }

    /// Half-steps that begin until the feet are side by side or the robot stands, if one of these lies ahead.
    fn half_steps_remaining(self) -> Option<u8> {
        match self {
            GaitState::InPlace { half_steps } => Some(half_steps + 1),
            GaitState::Stopping { half_steps, .. } => Some(half_steps),
            GaitState::Walking
            | GaitState::Settling { .. }
            | GaitState::Standing(_)
            | GaitState::Starting { .. }
            | GaitState::Returning { .. } => None,
        }
    }

    /// Half-steps that begin until the gait does what is commanded; 0 when it does.
    pub fn half_steps_to_goal(self) -> u8 {
        match self {
            GaitState::InPlace { half_steps } | GaitState::Stopping { half_steps, .. } => half_steps,
            GaitState::Walking
            | GaitState::Settling { .. }
            | GaitState::Standing(_)
            | GaitState::Starting { .. }
            | GaitState::Returning { .. } => 0,
        }
    }

    /// Whether half-step follows half-step, with no stand ahead.
    pub fn is_stepping(self) -> bool {
        matches!(self, GaitState::Walking | GaitState::InPlace { .. })
    }

    /// Whether the robot stands on both feet.
    pub fn is_standing(self) -> bool {
        matches!(
            self,
            GaitState::Settling { .. }
                | GaitState::Standing(_)
                | GaitState::Starting { .. }
                | GaitState::Returning { .. }
        )
    }

    /// Advances by a knot, and `walk` with it unless the robot stands. Returns whether a half-step began.
    ///
    /// * `whole` – the weight shift of the robot, with which it starts from a stand
    pub(crate) fn advance(&mut self, walk: &mut Walk, whole: WeightShift) -> bool {
        use GaitState::*;
        let begins = !self.is_standing() && walk.advance(KNOT);
        *self = match *self {
            InPlace { half_steps } if begins => InPlace { half_steps: half_steps.saturating_sub(1) },
            Stopping { half_steps: half_steps @ 2.., stance, goal } if begins => {
                Stopping { half_steps: half_steps - 1, stance, goal }
            }
            Stopping { stance, goal, .. } if begins => match whole.after_landing() {
                Some(shift) => Settling { stance, shift, goal },
                None => Standing(stance).with_goal(goal, whole),
            },
            Settling { stance, shift, goal } => match shift.advanced() {
                Some(shift) => Settling { stance, shift, goal },
                None => Standing(stance).with_goal(goal, whole),
            },
            Starting { stance, shift, goal } => match (shift.advanced(), goal) {
                (Some(shift), _) => Starting { stance, shift, goal },
                (None, Goal::Walk) => Walking,
                (None, Goal::InPlace) => InPlace { half_steps: 0 },
                (None, Goal::Stand(stance)) => Stopping { half_steps: 1, stance, goal },
            },
            Returning { stance, shift } => {
                shift.taken_back().map_or(Standing(stance), |shift| Returning { stance, shift })
            }
            same => same,
        };
        begins
    }

    /// Share of the weight on the support foot: 0.5 in a stand, 1 while walking.
    pub fn support_weight_share(self) -> f64 {
        match self {
            GaitState::Standing(_) => 0.5,
            GaitState::Settling { shift, .. }
            | GaitState::Starting { shift, .. }
            | GaitState::Returning { shift, .. } => shift.support_share(),
            _ => 1.0,
        }
    }

    /// Progress of the weight shift, linear in time: 0 in a stand, 1 while walking.
    pub fn weight_shift_progress(self) -> f64 {
        match self {
            GaitState::Standing(_) | GaitState::Settling { .. } => 0.0,
            GaitState::Starting { shift, .. } | GaitState::Returning { shift, .. } => shift.progress(),
            _ => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use GaitState::*;

    const WHOLE: WeightShift = WeightShift::AT_LEISURE;
    const STAND: Goal = Goal::Stand(Stance::Parallel);

    fn after(mut state: GaitState, goal: Goal) -> GaitState {
        state.set_goal(goal, WHOLE);
        state
    }

    /// The weight shift after so many knots.
    fn shifted(knots: u32) -> WeightShift {
        (0..knots).fold(WHOLE, |shift, _| shift.advanced().expect("it takes longer"))
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
        assert_eq!(state, Starting { stance: Stance::Stride, shift: WHOLE, goal: STAND });
        assert_eq!(after(state, STAND), state, "the weight shift does not begin anew");
        state = after(Standing(Stance::Parallel), STAND);
        assert_eq!(state, Standing(Stance::Parallel), "the feet are so already");
    }

    #[test]
    fn robot_that_cannot_stand_on_one_foot_settles_before_it_stands() {
        let (whole, goal) = (WeightShift::by_swaying(0.5), Goal::Walk);
        let shift = whole.after_landing().unwrap();
        let mut state = Settling { stance: Stance::Parallel, shift, goal: STAND };
        state.set_goal(goal, whole);
        assert_eq!(state, Settling { stance: Stance::Parallel, shift, goal }, "it does not begin anew");
        assert!(state.is_standing() && state.support_weight_share() == 0.9);
        assert_eq!(Standing(Stance::Parallel).with_goal(goal, whole).support_weight_share(), 0.5);
    }

    #[test]
    fn start_that_is_taken_back_returns_by_the_way_it_came() {
        let starting = Starting { stance: Stance::Parallel, shift: shifted(3), goal: Goal::Walk };
        let returning = after(starting, STAND);
        assert_eq!(returning.support_weight_share(), starting.support_weight_share(), "nothing jumps");
        assert_eq!(after(returning, Goal::Walk), starting, "and it may start again");
        let last = Returning { stance: Stance::Parallel, shift: shifted(1) };
        assert!(last.support_weight_share() - 0.5 < 1e-3, "then it stands");
    }

    #[test]
    fn weight_shifts_from_both_feet_to_one() {
        let start = Starting { stance: Stance::Parallel, shift: shifted(40), goal: Goal::Walk };
        assert_eq!(Standing(Stance::Parallel).support_weight_share(), 0.5);
        assert_eq!(start.support_weight_share(), 0.75);
        assert_eq!(Walking.support_weight_share(), 1.0);
    }
}
