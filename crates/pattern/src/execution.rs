//! The execution of a plan: what is played and sensed at present. It stays when another plan takes over.

use crate::knot::Knot;
use crate::planned_slope::PlannedSlope;
use crate::playback::Playback;
use crate::proportions::PatternProportions;
use crate::swing_clearance::{BodyTilt, SwingClearance};

/// What is played and sensed at present.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Execution {
    /// The present among the planned knots.
    pub playback: Playback,
    /// The slope of the ground.
    pub slope: PlannedSlope,
    /// Additional height of the swing sole.
    pub clearance: SwingClearance,
    /// Tilt of the body beyond the plan, in the newest knot's support coordinates.
    pub tilt: BodyTilt,
    /// Knots since the last step adjustment.
    pub knots_since_adjustment: u32,
    /// The half-step in which the way to a destination was corrected last.
    pub located_in: Option<u64>,
}

impl Execution {
    /// At the second of four knots, upright on level ground.
    pub(crate) fn new(proportions: &PatternProportions, knots: [Knot; 4]) -> Self {
        Self {
            playback: Playback::new(knots),
            slope: PlannedSlope::new(proportions),
            clearance: SwingClearance::default(),
            tilt: BodyTilt::default(),
            knots_since_adjustment: 0,
            located_in: None,
        }
    }

    /// Expresses tilt and clearance in support coordinates of the other foot, which supports from the newest knot on.
    pub(crate) fn change_support(&mut self) {
        self.clearance.change_support();
        self.tilt.tilt.x = -self.tilt.tilt.x;
    }
}
