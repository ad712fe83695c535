//! Histograms of measured times: share of the times over a logarithmic time axis.

use plots::picture::chart::{Chart, Panel, Pen, stack};

use crate::Series;

/// Colours of the series.
const COLOURS: [&str; 6] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];
const BINS: usize = 120;

/// Draws the histograms of several series in one picture.
pub(crate) fn histograms(group: &[Series]) -> String {
    let timed = || group.iter().filter(|series| series.count() > 0);
    let least = timed().map(|series| series.quantile(0.001)).fold(f64::INFINITY, f64::min).max(1.0) * 0.8;
    let greatest = timed().map(|series| series.quantile(0.999)).fold(0.0, f64::max).max(2.0 * least) * 1.5;
    let mut chart = Chart::new("µs", "share of the times, %");
    chart.log_x = true;
    let mut highest = 0.0_f64;
    for (series, colour) in group.iter().zip(COLOURS.iter().cycle()) {
        let pen = Pen::solid(colour, 1.6);
        let mut from = least;
        let mut steps = Vec::with_capacity(2 * BINS);
        for (to, share) in series.spread(least, greatest, BINS) {
            steps.extend([[from * 1e-3, 100.0 * share], [to * 1e-3, 100.0 * share]]);
            highest = highest.max(100.0 * share);
            from = to;
        }
        chart.line(steps, pen);
        chart.key_line(&series.name, pen);
    }
    let panel = Panel { chart, y_range: (0.0, highest * 1.05), height: 260.0 };
    stack(&group[0].group, (least * 1e-3, greatest * 1e-3), vec![panel])
}
