//! One panel of a picture over time: curves over light lines at support changes, marks of a fall on top.

use model::Mechanism;

use super::chart::{Chart, Panel, Pen, Point, stack};
use super::fall_marks::FallMarks;
use super::thinning::outlined;
use crate::run_log::{ControllerRow, RunLog};

/// Line at a support change.
const SUPPORT_CHANGE: Pen = Pen::solid("#C9CBDD", 0.8);
/// More support changes than this would cover everything, and are not marked.
const SUPPORT_CHANGES_MAX: usize = 120;
/// Share of the values that [`TimePanel::usual`] leaves out at each end of its range: at every support change the
/// zero-moment point comes from the other foot, far outside the support sole, and would flatten everything else.
const LEFT_OUT: f64 = 0.03;

/// Most points of a curve.
const POINTS: usize = 2000;

/// Builds a panel over time.
pub(super) struct TimePanel {
    chart: Chart,
    bands: Vec<([Point; 4], Pen)>,
    curves: Vec<(Vec<Point>, Pen)>,
    range: (f64, f64),
    left_out: f64,
    /// Values below are not in the range, whatever is drawn.
    lowest: f64,
}

impl TimePanel {
    /// A panel whose range includes all values, and the values `always`.
    pub(super) fn new(y_label: &str, always: &[f64]) -> Self {
        let range = always.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), y| (min.min(*y), max.max(*y)));
        Self {
            chart: Chart::new("", y_label),
            bands: Vec::new(),
            curves: Vec::new(),
            range,
            left_out: 0.0,
            lowest: f64::NEG_INFINITY,
        }
    }

    /// A panel whose range leaves out rare values, but includes the values `always`.
    pub(super) fn usual(y_label: &str, always: &[f64]) -> Self {
        Self { left_out: LEFT_OUT, ..Self::new(y_label, always) }
    }

    /// Leaves out what is lower.
    pub(super) fn not_below(self, lowest: f64) -> Self {
        Self { lowest, ..self }
    }

    /// Draws a quantity over time; NaN leaves a gap.
    pub(super) fn draw(&mut self, label: &str, pen: Pen, points: Vec<Point>) {
        let mut values: Vec<f64> = points.iter().map(|point| point[1]).filter(|y| y.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let left_out = (values.len() as f64 * self.left_out) as usize;
        if let (Some(min), Some(max)) = (values.get(left_out), values.iter().rev().nth(left_out)) {
            self.range = (self.range.0.min(*min), self.range.1.max(*max));
        }
        self.curves.push((outlined(&points, POINTS), pen));
        self.chart.key_line(label, pen);
    }

    /// The greatest of the values that were drawn, either way.
    pub(super) fn greatest(&self) -> f64 {
        let values = self.curves.iter().flat_map(|(points, _)| points.iter().map(|point| point[1].abs()));
        values.filter(|value| value.is_finite()).fold(0.0, f64::max)
    }

    /// Extends the range to values.
    pub(super) fn include(&mut self, values: &[f64]) {
        self.range = values.iter().fold(self.range, |(min, max), value| (min.min(*value), max.max(*value)));
    }

    /// Draws a quantity of the controller over time; `None` leaves a gap.
    pub(super) fn draw_of(
        &mut self,
        label: &str,
        pen: Pen,
        rows: &[ControllerRow],
        quantity: impl Fn(&ControllerRow) -> Option<f64>,
    ) {
        self.draw(label, pen, rows.iter().map(|row| [row.time, quantity(row).unwrap_or(f64::NAN)]).collect());
    }

    /// Fills the area between two values over some time.
    pub(super) fn band(
        &mut self,
        label: &str,
        colour: &'static str,
        (from, to): (f64, f64),
        (least, greatest): (f64, f64),
    ) {
        self.range = (self.range.0.min(least), self.range.1.max(greatest));
        let corners = [[from, least], [to, least], [to, greatest], [from, greatest]];
        if self.bands.iter().all(|(_, pen)| pen.colour != colour) {
            self.chart.key_area(label, colour);
        }
        self.bands.push((corners, Pen::solid(colour, 0.4)));
    }

    /// Draws horizontal lines across the panel.
    pub(super) fn level(&mut self, label: &str, values: &[f64], pen: Pen) {
        for value in values {
            self.chart.level(*value, pen);
        }
        self.chart.key_line(label, pen);
    }

    /// Finishes the panel: bands, then support changes, curves over them, and the fall over all.
    fn finish(mut self, support_changes: &[f64], fall: &FallMarks, height: f64) -> Panel {
        // An empty run has no values.
        let (least, greatest) = if self.range.0 < self.range.1 { self.range } else { (0.0, 1.0) };
        let least = least.max(self.lowest);
        let pad = 0.08 * (greatest - least);
        let (bottom, top) = (least - pad, greatest + pad);
        for (corners, pen) in self.bands {
            self.chart.polygon(&corners, pen, 0.2);
        }
        for &support_change in support_changes {
            self.chart.line([[support_change, bottom], [support_change, top]], SUPPORT_CHANGE);
        }
        for (curve, pen) in self.curves {
            self.chart.line(curve, pen);
        }
        fall.draw_over_time(&mut self.chart, (bottom, top));
        Panel { chart: self.chart, y_range: (bottom, top), height }
    }
}

/// Draws panels below each other, each `height` (px) high.
pub(super) fn picture(
    title: &str,
    log: &RunLog,
    mechanism: &Mechanism,
    (from, to): (f64, f64),
    height: f64,
    panels: Vec<TimePanel>,
) -> String {
    let fall = FallMarks::of(log, mechanism);
    let support_changes = log.half_steps().skip(1).map(|half_step| half_step[0].time);
    let mut support_changes: Vec<f64> =
        support_changes.filter(|support_change| (from..to).contains(support_change)).collect();
    if support_changes.len() > SUPPORT_CHANGES_MAX {
        support_changes.clear();
    }
    let mut panels: Vec<Panel> =
        panels.into_iter().map(|panel| panel.finish(&support_changes, &fall, height)).collect();
    // A panel in which nothing is drawn would be left out, and the legend and the axis of the last one with it.
    if panels.iter().any(|panel| !panel.chart.is_empty()) {
        panels.retain(|panel| !panel.chart.is_empty());
    }
    if let Some(Panel { chart, .. }) = panels.last_mut() {
        chart.x_label = "time [s]".into();
        if !support_changes.is_empty() {
            chart.key_line("support change", SUPPORT_CHANGE);
        }
        fall.key_over_time(chart);
    }
    stack(&format!("{title}{}", fall.title()), (from, to), panels)
}

/// Times of the first and the last row (s).
pub(super) fn whole_run(log: &RunLog) -> (f64, f64) {
    log.span().unwrap_or((0.0, 1.0))
}
