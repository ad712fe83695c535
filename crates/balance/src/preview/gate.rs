//! Stop and start: at a swap both soles are on the ground and at rest, so there the walk can be held and let go again.

use gait::Walk;

use crate::preview::KNOT;
use crate::preview::swing_path::smooth_step;

/// Whether the walk goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gate {
    /// Half-step after half-step.
    Open,
    /// To a stand, and on from there if asked meanwhile.
    Closing {
        /// How many half-steps begin until then.
        swaps: u8,
        /// How the feet shall stand.
        stance: Stance,
        /// Whether to walk on after the stand.
        reopen: bool,
    },
    /// Standing on both feet.
    Closed(Stance),
    /// The weight goes to the foot that is to bear.
    Opening {
        /// How the feet stand.
        stance: Stance,
        /// How many knots are left.
        left: u32,
    },
}

/// How the feet stand when the walk has stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stance {
    /// As they landed, one before the other.
    Stride,
    /// Side by side.
    Parallel,
}

/// The half-step in which the stop is asked for goes on as it is, the next one is calm.
const SWAPS_TO_STAND: u8 = 2;
/// How long the weight takes from the middle to the foot: 0.8 s.
const SHIFT_KNOTS: u32 = 80;

impl Gate {
    /// Asks the walk to come to a stand.
    pub fn close(&mut self, stance: Stance) {
        *self = match *self {
            Gate::Open => Gate::Closing { swaps: SWAPS_TO_STAND, stance, reopen: false },
            Gate::Closing { swaps, stance, .. } => Gate::Closing { swaps, stance, reopen: false },
            Gate::Closed(stance) => Gate::Closed(stance),
            Gate::Opening { stance, .. } => Gate::Closed(stance),
        };
    }

    /// How many half-steps begin before it stands; none when it walks on or stands.
    pub fn swaps_to_stand(self) -> u8 {
        if let Gate::Closing { swaps, .. } = self { swaps } else { 0 }
    }

    /// Asks the walk to go on. Once the last half-step before a stand has begun it is too late to take that back.
    pub fn open(&mut self) {
        *self = match *self {
            Gate::Closing { swaps: 2.., .. } => Gate::Open,
            Gate::Closing { swaps, stance, .. } => Gate::Closing { swaps, stance, reopen: true },
            Gate::Closed(stance) => Gate::Opening { stance, left: SHIFT_KNOTS },
            open => open,
        };
    }

    /// Whether the present half-step ends with the feet side by side.
    pub fn lands_parallel(self) -> bool {
        matches!(self, Gate::Closing { swaps: 1, stance: Stance::Parallel, .. })
    }

    /// Moves a walk on by a knot as far as the gate lets it, and says whether a half-step began.
    pub fn advance(&mut self, walk: &mut Walk) -> bool {
        match *self {
            Gate::Open => walk.advance(KNOT),
            Gate::Closing { swaps, stance, reopen } => {
                let begins = walk.advance(KNOT);
                if begins {
                    *self = match (swaps, reopen) {
                        (2.., _) => Gate::Closing { swaps: swaps - 1, stance, reopen },
                        (_, true) => Gate::Opening { stance, left: SHIFT_KNOTS },
                        (_, false) => Gate::Closed(stance),
                    };
                }
                begins
            }
            Gate::Closed(_) => false,
            Gate::Opening { stance, left } => {
                *self = if left > 1 { Gate::Opening { stance, left: left - 1 } } else { Gate::Open };
                false
            }
        }
    }

    /// Whether the robot is on both feet.
    pub fn is_standing(self) -> bool {
        matches!(self, Gate::Closed(_) | Gate::Opening { .. })
    }

    /// Share of the weight that the bearing foot is to carry: half when standing, all when walking.
    pub fn weight_on_bearing(self) -> f64 {
        match self {
            Gate::Open | Gate::Closing { .. } => 1.0,
            Gate::Closed(_) => 0.5,
            Gate::Opening { .. } => 0.5 + 0.5 * smooth_step(self.shifted()),
        }
    }

    /// How much of the time for the shift of weight has passed: from 0 when standing to 1 when walking.
    pub fn shifted(self) -> f64 {
        match self {
            Gate::Open | Gate::Closing { .. } => 1.0,
            Gate::Closed(_) => 0.0,
            Gate::Opening { left, .. } => 1.0 - f64::from(left) / f64::from(SHIFT_KNOTS),
        }
    }
}
