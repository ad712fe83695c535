//! The least margin of a run, and where in the walk it was.

use model::Side;
use serde::Serialize;

use super::RunLog;

/// The least margin of the measured zero-moment point away from support changes, at which it moves from foot to foot,
/// while the controller balanced the robot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeastMargin {
    /// Distance from the edge of the support polygon, negative outside (mm).
    pub margin_mm: f64,
    /// When it was (s).
    pub time_s: f64,
    /// The half-step in which it was, counted from 0.
    pub half_step: u64,
    /// The share of the half-step that was done, 0 to 1.
    pub progress: f64,
    /// The support foot.
    pub support: Side,
}

impl RunLog {
    /// The least margin; `None` if it was never measured.
    pub(super) fn least_margin(&self) -> Option<LeastMargin> {
        let rows = self.controller.iter().filter(|row| row.is_off_support_changes() && row.is_balancing());
        let margins = rows.filter_map(|row| Some((row, row.margin.filter(|margin| margin.is_finite())?)));
        let (row, margin) = margins.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        Some(LeastMargin {
            margin_mm: margin * 1e3,
            time_s: row.time,
            half_step: row.half_step,
            progress: row.progress,
            support: row.support,
        })
    }
}
