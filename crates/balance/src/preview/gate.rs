//! Stop and start, and steps in place: at a swap both soles are on the ground and at rest, so there the walk can be held
//! and let go again.

use gait::Walk;

use crate::preview::KNOT;
use crate::preview::swing_path::smooth_step;

/// What the walk is to come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// Half-step after half-step.
    Walk,
    /// Half-steps of no length, the feet side by side after each.
    InPlace,
    /// A stand.
    Stand(Stance),
}

/// How the feet stand when the walk has stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stance {
    /// As they landed, one before the other.
    Stride,
    /// Side by side.
    Parallel,
}

/// Whether the walk goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gate {
    /// Half-step after half-step.
    Open,
    /// The same, in place.
    InPlace {
        /// How many half-steps begin until one lands with the feet side by side.
        swaps: u8,
    },
    /// To a stand.
    Closing {
        /// How many half-steps begin until then.
        swaps: u8,
        /// How the feet shall stand.
        stance: Stance,
        /// What is to come after the stand.
        goal: Goal,
    },
    /// Standing on both feet.
    Closed(Stance),
    /// The weight goes to the foot that is to bear.
    Opening {
        /// How the feet stand.
        stance: Stance,
        /// How many knots are left.
        left: u32,
        /// What is to come after that.
        goal: Goal,
    },
}

/// The half-step in which the stop is asked for goes on as it is, the next one is calm.
const SWAPS_TO_STAND: u8 = 2;
/// How long the weight takes from the middle to the foot: 0.8 s.
const SHIFT_KNOTS: u32 = 80;

impl Gate {
    /// Asks for something else. Once the last half-step before a stand has begun, it is too late to take that back.
    pub fn aim(&mut self, goal: Goal) {
        let opening = |stance, left| Gate::Opening { stance, left, goal };
        *self = match (*self, goal) {
            (Gate::Closing { swaps: 1, stance, .. }, _) => Gate::Closing { swaps: 1, stance, goal },
            // In place the feet are side by side already.
            (Gate::InPlace { swaps: 0 }, Goal::Stand(_)) => Gate::Closing { swaps: 1, stance: Stance::Parallel, goal },
            (Gate::Open | Gate::InPlace { .. } | Gate::Closing { .. }, Goal::Stand(stance)) => {
                Gate::Closing { swaps: self.half_steps_left().unwrap_or(SWAPS_TO_STAND), stance, goal }
            }
            (Gate::Open | Gate::InPlace { .. } | Gate::Closing { .. }, Goal::Walk) => Gate::Open,
            (in_place @ Gate::InPlace { .. }, Goal::InPlace) => in_place,
            (Gate::Open | Gate::Closing { .. }, Goal::InPlace) => {
                Gate::InPlace { swaps: self.half_steps_left().unwrap_or(SWAPS_TO_STAND) - 1 }
            }
            (Gate::Closed(Stance::Stride), Goal::Stand(Stance::Parallel)) => opening(Stance::Stride, SHIFT_KNOTS),
            (Gate::Opening { stance: Stance::Stride, left, .. }, Goal::Stand(Stance::Parallel)) => {
                opening(Stance::Stride, left)
            }
            (Gate::Closed(stance) | Gate::Opening { stance, .. }, Goal::Stand(_)) => Gate::Closed(stance),
            (Gate::Closed(stance), _) => opening(stance, SHIFT_KNOTS),
            (Gate::Opening { stance, left, .. }, _) => opening(stance, left),
        };
    }

    /// How many half-steps begin until the feet are side by side or stand, if that is to come.
    fn half_steps_left(self) -> Option<u8> {
        match self {
            Gate::InPlace { swaps } => Some(swaps + 1),
            Gate::Closing { swaps, .. } => Some(swaps),
            Gate::Open | Gate::Closed(_) | Gate::Opening { .. } => None,
        }
    }

    /// How many half-steps begin before it does what it is asked to; none when it does.
    pub fn swaps_to_goal(self) -> u8 {
        match self {
            Gate::InPlace { swaps } | Gate::Closing { swaps, .. } => swaps,
            Gate::Open | Gate::Closed(_) | Gate::Opening { .. } => 0,
        }
    }

    /// Whether half-steps come one after the other.
    pub fn walks(self) -> bool {
        matches!(self, Gate::Open | Gate::InPlace { .. })
    }

    /// Moves a walk on by a knot as far as the gate lets it, and says whether a half-step began.
    pub fn advance(&mut self, walk: &mut Walk) -> bool {
        let begins = !self.is_standing() && walk.advance(KNOT);
        *self = match *self {
            Gate::InPlace { swaps } if begins => Gate::InPlace { swaps: swaps.saturating_sub(1) },
            Gate::Closing { swaps: swaps @ 2.., stance, goal } if begins => {
                Gate::Closing { swaps: swaps - 1, stance, goal }
            }
            Gate::Closing { stance, goal, .. } if begins => {
                let mut stand = Gate::Closed(stance);
                stand.aim(goal);
                stand
            }
            Gate::Opening { stance, left: left @ 2.., goal } => Gate::Opening { stance, left: left - 1, goal },
            Gate::Opening { goal: Goal::Walk, .. } => Gate::Open,
            Gate::Opening { goal: Goal::InPlace, .. } => Gate::InPlace { swaps: 0 },
            Gate::Opening { goal: goal @ Goal::Stand(stance), .. } => Gate::Closing { swaps: 1, stance, goal },
            same => same,
        };
        begins
    }

    /// Whether the robot is on both feet.
    pub fn is_standing(self) -> bool {
        matches!(self, Gate::Closed(_) | Gate::Opening { .. })
    }

    /// Share of the weight that the bearing foot is to carry: half when standing, all when walking.
    pub fn weight_on_bearing(self) -> f64 {
        match self {
            Gate::Closed(_) => 0.5,
            Gate::Opening { .. } => 0.5 + 0.5 * smooth_step(self.shifted()),
            _ => 1.0,
        }
    }

    /// How much of the time for the shift of weight has passed: from 0 when standing to 1 when walking.
    pub fn shifted(self) -> f64 {
        match self {
            Gate::Closed(_) => 0.0,
            Gate::Opening { left, .. } => 1.0 - f64::from(left) / f64::from(SHIFT_KNOTS),
            _ => 1.0,
        }
    }
}
