//! Zero-moment point, margin, compensation and commands over time.

use model::Mechanism;

use super::chart::{Chart, Panel, Pen, Point, stack};
use super::thinning::outlined;
use super::{COM, EDGE, FALL, LEFT, PLANNED, RIGHT, ZMP};
use crate::run_log::{ControllerRow, RunLog};

/// Of the whole picture [px].
const WIDTH: f64 = 1500.0;
/// Of one panel [px].
const HEIGHT: f64 = 175.0;
/// What the time axis adds to the lowest panel [px].
const TIME_AXIS: f64 = 44.0;
/// Marks where the other foot takes over.
const SWAP: Pen = Pen::solid("#C9CBDD", 0.8);
/// The share of the values that a range may leave out at each end: at every swap the zero-moment point comes over from the
/// other foot, far outside the bearing sole, and would flatten everything else.
const LEFT_OUT: f64 = 0.03;

/// Six panels over one time axis, with a light line at each swap and a red one at a fall.
pub fn zmp_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let sole = &mechanism.sole;
    let rows = &log.controller;
    let edge = Pen::dashed(EDGE, 1.0);

    let mut zmp_x = PanelOf::new("ZMP x [m]", rows, &[-sole.behind, sole.ahead]);
    zmp_x.draw("planned", Pen::solid(PLANNED, 1.6), |row| row.zmp_planned.map(|zmp| zmp.x));
    zmp_x.draw("measured", Pen::solid(ZMP, 0.8), |row| row.zmp_measured.map(|zmp| zmp.x));
    zmp_x.level("heel and toe", &[-sole.behind, sole.ahead], edge);

    let mut zmp_y = PanelOf::new("ZMP y, inward [m]", rows, &[-sole.half_width, sole.half_width]);
    zmp_y.draw("planned", Pen::solid(PLANNED, 1.6), |row| row.zmp_planned.map(|zmp| zmp.y));
    zmp_y.draw("measured", Pen::solid(ZMP, 0.8), |row| row.zmp_measured.map(|zmp| zmp.y));
    zmp_y.level("sole edges", &[-sole.half_width, sole.half_width], edge);

    let mut margin = PanelOf::new("margin [mm]", rows, &[-5.0, 45.0]);
    margin.draw("ZMP to edge", Pen::solid(ZMP, 0.8), |row| row.margin.map(|margin| margin * 1e3));
    margin.level("edge", &[0.0], Pen::solid(FALL, 1.0));

    let mut lean = PanelOf::new("lean [°]", rows, &[-1.0, 1.0]);
    lean.draw("about x (roll)", Pen::solid(RIGHT, 1.0), |row| Some(row.lean_roll.to_degrees()));
    lean.draw("about y (pitch)", Pen::solid(LEFT, 1.0), |row| Some(row.lean_pitch.to_degrees()));

    let mut angles = PanelOf::new("command [°]", rows, &[-5.0, 5.0]);
    angles.draw("turn", Pen::solid(RIGHT, 1.6), |row| Some(row.turn_command.to_degrees()));
    angles.draw("extension", Pen::solid(LEFT, 1.6), |row| Some(row.extension_command.to_degrees()));

    let mut speed = PanelOf::new("speed [1]", rows, &[0.9, 1.1]);
    speed.draw("in force", Pen::dashed(PLANNED, 1.2), |row| Some(row.speed_command));
    speed.draw("now", Pen::solid(COM, 1.6), |row| Some(row.speed));

    let falls: Vec<f64> = log.falls().collect();
    let swaps: Vec<f64> = log.half_steps().skip(1).map(|half_step| half_step[0].time).collect();
    let times = rows.first().zip(rows.last()).map_or((0.0, 1.0), |(first, last)| (first.time, last.time));
    zmp_x.chart.key_line("swap", SWAP);
    speed.chart.x_label = "time [s]".into();
    let panels = [(zmp_x, HEIGHT), (zmp_y, HEIGHT), (margin, HEIGHT), (lean, HEIGHT), (angles, HEIGHT)];
    let panels = panels.into_iter().chain([(speed, HEIGHT + TIME_AXIS)]);
    let panels = panels.map(|(panel, height)| panel.finish(&swaps, &falls, height)).collect();
    let title = match falls.first() {
        Some(fall) => format!("Balance and commands over time; it fell at {fall:.2} s"),
        None => "Balance and commands over time".to_string(),
    };
    stack(&title, WIDTH, times, panels)
}

/// A panel in the making.
struct PanelOf<'l> {
    rows: &'l [ControllerRow],
    chart: Chart,
    curves: Vec<(Vec<Point>, Pen)>,
    range: (f64, f64),
}

impl<'l> PanelOf<'l> {
    /// A panel that shows `always` at least.
    fn new(y_label: &str, rows: &'l [ControllerRow], always: &[f64]) -> Self {
        let range = always.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), y| (min.min(*y), max.max(*y)));
        Self { rows, chart: Chart::new("", y_label), curves: Vec::new(), range }
    }

    /// One quantity over time.
    fn draw(&mut self, label: &str, pen: Pen, quantity: impl Fn(&ControllerRow) -> Option<f64>) {
        let points: Vec<Point> = self.rows.iter().map(|row| [row.time, quantity(row).unwrap_or(f64::NAN)]).collect();
        let mut values: Vec<f64> = points.iter().map(|point| point[1]).filter(|y| y.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let left_out = (values.len() as f64 * LEFT_OUT) as usize;
        if let (Some(min), Some(max)) = (values.get(left_out), values.iter().rev().nth(left_out)) {
            self.range = (self.range.0.min(*min), self.range.1.max(*max));
        }
        self.curves.push((outlined(&points), pen));
        self.chart.key_line(label, pen);
    }

    /// Fixed values across the panel.
    fn level(&mut self, label: &str, values: &[f64], pen: Pen) {
        for value in values {
            self.chart.level(*value, pen);
        }
        self.chart.key_line(label, pen);
    }

    /// The curves over the swaps, and the falls over the curves.
    fn finish(mut self, swaps: &[f64], falls: &[f64], height: f64) -> Panel {
        let pad = 0.08 * (self.range.1 - self.range.0);
        let (bottom, top) = (self.range.0 - pad, self.range.1 + pad);
        for &swap in swaps {
            self.chart.line([[swap, bottom], [swap, top]], SWAP);
        }
        for (curve, pen) in self.curves {
            self.chart.line(curve, pen);
        }
        for &fall in falls {
            self.chart.line([[fall, bottom], [fall, top]], Pen::solid(FALL, 1.5));
        }
        Panel { chart: self.chart, y_range: (bottom, top), height }
    }
}
