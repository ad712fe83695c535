//! A place in the walk: the half-step and the progress through it.

use model::Side;

/// A place in the walk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfStep {
    /// Number of half-steps completed before this one.
    pub index: u64,
    /// The foot that supports the robot.
    pub support: Side,
    /// `s`: share of the half-step that is done, from 0 up to but not including 1.
    pub progress: f64,
}

impl HalfStep {
    /// The beginning of the first half-step, supported by `support`.
    pub const fn first(support: Side) -> Self {
        Self { index: 0, support, progress: 0.0 }
    }

    /// Whether its end is reached: time for [`begin_next`](Self::begin_next).
    pub fn is_over(&self) -> bool {
        self.progress >= 1.0
    }

    /// The other foot supports from here on; progress beyond the end is carried over.
    pub fn begin_next(&mut self) {
        self.index += 1;
        self.support = self.support.other();
        self.progress -= 1.0;
    }
}
