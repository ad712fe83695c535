//! Which half-step the walk is in, and how far through.

use model::Side;

/// A place in the walk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfStep {
    /// How many half-steps were completed before this one.
    pub index: u64,
    /// The foot that bears.
    pub support: Side,
    /// `s`: how far through, from 0 up to but not including 1.
    pub progress: f64,
}

impl HalfStep {
    /// The first one, standing on `support`.
    pub const fn first(support: Side) -> Self {
        Self { index: 0, support, progress: 0.0 }
    }

    /// Whether its end is reached: time to [`swap`](Self::swap).
    pub fn is_over(&self) -> bool {
        self.progress >= 1.0
    }

    /// The other foot bears from here on; progress beyond the end is carried over.
    pub fn swap(&mut self) {
        self.index += 1;
        self.support = self.support.other();
        self.progress -= 1.0;
    }
}
