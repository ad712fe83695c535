//! Marks for a fall and for the moment from which it was unavoidable.

use model::Mechanism;

use super::chart::{Chart, Pen, Point};
use super::colours::FALL;
use crate::run_log::{Fall, RunLog};

const FELL: Pen = Pen::solid(FALL, 2.2);
const UNAVOIDABLE: Pen = Pen::dashed(FALL, 2.2);
/// Half the size of a mark on the floor (m).
const ARM: f64 = 0.03;

/// Marks for the first fall of a run, if the robot fell.
pub(super) struct FallMarks {
    fall: Option<Fall>,
    /// Whether it lay there already where the drawn part of the run begins.
    lay_before: bool,
}

impl FallMarks {
    /// Marks for the first fall of a run.
    pub(super) fn of(log: &RunLog, mechanism: &Mechanism) -> Self {
        let lay_before = log.is_part && log.plant.first().is_some_and(|row| row.fallen);
        Self { fall: log.first_fall(mechanism).filter(|_| !lay_before), lay_before }
    }

    /// The fall as an addition to a picture's title; empty without a fall.
    pub(super) fn title(&self) -> String {
        match self.fall {
            Some(fall) => format!("; it fell at {:.2} s", fall.time_s),
            None if self.lay_before => "; it had fallen before".to_owned(),
            None => String::new(),
        }
    }

    /// Draws lines across a panel over time.
    pub(super) fn draw_over_time(&self, chart: &mut Chart, (bottom, top): (f64, f64)) {
        let Some(fall) = self.fall else { return };
        let mut line = |time: f64, pen| chart.line([[time, bottom], [time, top]], pen);
        line(fall.time_s, FELL);
        if let Some(time) = fall.unavoidable_s {
            line(time, UNAVOIDABLE);
        }
    }

    /// Draws a cross on the floor where the centre of mass was at the fall, and a diamond where the capture point left
    /// the soles.
    pub(super) fn draw_on_floor(&self, chart: &mut Chart, log: &RunLog) {
        let Some(fall) = self.fall else { return };
        if let Some(row) = log.plant_at(fall.time_s) {
            let [x, y] = [row.com_in_world.x, row.com_in_world.y];
            chart.line([[x - ARM, y - ARM], [x + ARM, y + ARM]], FELL);
            chart.line([[x - ARM, y + ARM], [x + ARM, y - ARM]], FELL);
        }
        let left = fall.unavoidable_s.map(|time| log.plant.partition_point(|row| row.time < time));
        if let Some(point) = left.and_then(|row| log.divergent_component(row)) {
            let corner = |dx: f64, dy: f64| -> Point { [point.x + dx, point.y + dy] };
            let corners = [corner(ARM, 0.0), corner(0.0, ARM), corner(-ARM, 0.0), corner(0.0, -ARM)];
            chart.polygon(&corners, Pen::solid(FALL, 1.5), 0.35);
        }
    }

    /// Adds the lines to a legend.
    pub(super) fn key_over_time(&self, chart: &mut Chart) {
        let Some(fall) = self.fall else { return };
        chart.key_line("fell", FELL);
        if let Some(time) = fall.unavoidable_s {
            chart.key_line(&format!("unavoidable, from {time:.2} s on"), UNAVOIDABLE);
        }
    }

    /// Adds the marks on the floor to a legend.
    pub(super) fn key_on_floor(&self, chart: &mut Chart) {
        let Some(fall) = self.fall else { return };
        chart.key_line("cross: it fell, centre of mass", FELL);
        if fall.unavoidable_s.is_some() {
            chart.key_area("diamond: unavoidable from here", FALL);
        }
    }
}
