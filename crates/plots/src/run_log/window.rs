//! A part of a run.

/// A part of a run: from a time to a time since its start (s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeWindow {
    /// Where it begins (s).
    pub from: f64,
    /// Where it ends (s).
    pub to: f64,
}

impl TimeWindow {
    /// All of a run.
    pub const ALL: TimeWindow = TimeWindow { from: f64::NEG_INFINITY, to: f64::INFINITY };

    /// Whether a time (s) lies in it.
    pub fn contains(&self, time: f64) -> bool {
        (self.from..=self.to).contains(&time)
    }
}
