//! A chart of lines and filled polygons; the only file that uses kuva.

use kuva::backend::svg::SvgBackend;
use kuva::plot::annotations::{ReferenceLine, TextAnnotation};
use kuva::plot::legend::{LegendEntry, LegendPosition, LegendShape};
use kuva::plot::line::{LinePlot, LineStyle};
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::Scene;

/// A point in the chart's units.
pub type Point = [f64; 2];

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// Colour as in HTML: `#0072B2`.
    pub colour: &'static str,
    /// Line width (px), at scale 1.
    pub width: f64,
    /// Whether the line is dashed.
    pub dashed: bool,
}

impl Pen {
    /// A continuous line.
    pub const fn solid(colour: &'static str, width: f64) -> Self {
        Self { colour, width, dashed: false }
    }

    /// A dashed line.
    pub const fn dashed(colour: &'static str, width: f64) -> Self {
        Self { colour, width, dashed: true }
    }
}

/// Lines and polygons with axes.
pub struct Chart {
    /// Quantity and unit of the horizontal axis; empty if another panel has it.
    pub x_label: String,
    y_label: String,
    /// Whether the x axis is logarithmic.
    pub log_x: bool,
    plots: Vec<Plot>,
    legend: Vec<LegendEntry>,
    levels: Vec<ReferenceLine>,
    texts: Vec<TextAnnotation>,
    /// Corners of all that was drawn: least x and y, greatest x and y.
    extent: Option<[Point; 2]>,
}

const DASHES: &str = "6 4";
/// Space around the axes (px at scale 1).
const MARGIN_LEFT: f64 = 78.0;
const MARGIN_RIGHT: f64 = 26.0;
const MARGIN_TOP: f64 = 12.0;
const MARGIN_BOTTOM: f64 = 52.0;
/// Least distance between the ticks of a map: along x, where labels are side by side, and along y (px at scale 1).
const TICK_DISTANCE_MIN: Point = [60.0, 34.0];
/// Wider axes get larger letters and wider lines, so that the whole picture can be read on a phone (px).
const WIDTH_OF_SCALE_1: f64 = 560.0;
/// Least width of a map, which leaves room for legend and title (px).
const MAP_WIDTH_MIN: f64 = 520.0;
/// Greatest width and height of a map (px): a longer walk is drawn smaller.
const MAP_SIZE_MAX: f64 = 40_000.0;
/// No coordinate that is drawn is larger.
const FAR: f64 = 1e10;
/// Number of columns of a legend whose labels are at most so long (characters).
const LEGEND_COLUMNS: usize = 2;
const LEGEND_LABEL_MAX: usize = 33;
/// Height of a legend's line, and space above and below the lines (px at scale 1).
const LEGEND_LINE: f64 = 18.0;
const LEGEND_SPACE: f64 = 30.0;

impl Chart {
    /// An empty chart; the labels have quantity and unit.
    pub fn new(x_label: impl Into<String>, y_label: impl Into<String>) -> Self {
        Self {
            x_label: x_label.into(),
            y_label: y_label.into(),
            log_x: false,
            plots: Vec::new(),
            legend: Vec::new(),
            levels: Vec::new(),
            texts: Vec::new(),
            extent: None,
        }
    }

    /// Draws a line through points, with gaps where a point is not finite or far beyond everything.
    pub fn line(&mut self, points: impl IntoIterator<Item = Point>, pen: Pen) {
        let points: Vec<Point> = points.into_iter().collect();
        for piece in points.split(|point| !can_be_drawn(point)).filter(|piece| piece.len() > 1) {
            self.include(piece);
            let style = if pen.dashed { LineStyle::Custom(DASHES.into()) } else { LineStyle::Solid };
            let line = LinePlot::new().with_data(piece.iter().map(|&[x, y]| (x, y)));
            let line = line.with_color(pen.colour).with_stroke_width(pen.width).with_line_style(style);
            self.plots.push(line.into());
        }
    }

    /// Draws a filled polygon, unless a corner cannot be drawn; `opacity` is that of the filling, from 0 to 1.
    pub fn polygon(&mut self, corners: &[Point], pen: Pen, opacity: f64) {
        if !corners.iter().all(can_be_drawn) {
            return;
        }
        self.include(corners);
        // The filling of a closed line is the polygon itself.
        let closed = corners.iter().chain(corners.first()).map(|&[x, y]| (x, y));
        let outline = LinePlot::new().with_data(closed).with_color(pen.colour).with_stroke_width(pen.width);
        self.plots.push(outline.with_fill().with_fill_opacity(opacity).into());
    }

    /// Draws a horizontal line across the whole chart.
    pub fn level(&mut self, y: f64, pen: Pen) {
        let dashes = if pen.dashed { DASHES } else { "none" };
        let line = ReferenceLine::horizontal(y).with_color(pen.colour);
        self.levels.push(line.with_stroke_width(pen.width).with_dasharray(dashes));
    }

    /// Draws text centred on a point.
    pub fn text(&mut self, text: impl Into<String>, [x, y]: Point) {
        self.texts.push(TextAnnotation::new(text.into(), x, y).with_color("#333333"));
    }

    /// Whether nothing was drawn.
    pub fn is_empty(&self) -> bool {
        self.plots.is_empty()
    }

    /// Adds a line to the legend.
    pub fn key_line(&mut self, label: &str, pen: Pen) {
        let dasharray = pen.dashed.then(|| DASHES.to_string());
        self.legend.push(LegendEntry {
            label: label.into(),
            color: pen.colour.into(),
            shape: LegendShape::Line,
            dasharray,
        });
    }

    /// Adds a filled area to the legend.
    pub fn key_area(&mut self, label: &str, colour: &str) {
        let (label, color) = (label.into(), colour.into());
        self.legend.push(LegendEntry { label, color, shape: LegendShape::Rect, dasharray: None });
    }

    /// Extends the ranges of the chart to points without drawing them.
    pub fn include(&mut self, points: &[Point]) {
        for &[x, y] in points.iter().filter(|point| can_be_drawn(point)) {
            let [min, max] = self.extent.get_or_insert([[x, y], [x, y]]);
            *min = [min[0].min(x), min[1].min(y)];
            *max = [max[0].max(x), max[1].max(y)];
        }
    }

    /// Corners of all that was drawn: least x and y, greatest x and y; the unit square if nothing was.
    pub fn extent(&self) -> [Point; 2] {
        self.extent.unwrap_or([[0.0; 2], [1.0; 2]])
    }

    /// The greater of width and height of all that was drawn.
    pub fn span(&self) -> f64 {
        let [min, max] = self.extent();
        (max[0] - min[0]).max(max[1] - min[1])
    }

    /// Makes all lines wider.
    fn widen_lines(&mut self, factor: f64) {
        for plot in &mut self.plots {
            if let Plot::Line(line) = plot {
                line.stroke_width *= factor;
            }
        }
        for level in &mut self.levels {
            level.stroke_width *= factor;
        }
    }

    fn layout(&mut self, x_range: (f64, f64), y_range: (f64, f64), letters: f64) -> Layout {
        let mut layout = Layout::new(x_range, y_range)
            .with_x_axis_min(x_range.0)
            .with_x_axis_max(x_range.1)
            .with_y_axis_min(y_range.0)
            .with_y_axis_max(y_range.1)
            .with_x_label(&self.x_label)
            .with_y_label(&self.y_label)
            .with_font_family("Helvetica, Arial, sans-serif")
            .with_scale(letters);
        if self.log_x {
            layout = layout.with_log_x();
        }
        for line in self.levels.drain(..) {
            layout = layout.with_reference_line(line);
        }
        for text in self.texts.drain(..) {
            layout = layout.with_annotation(text.with_font_size((12.0 * letters) as u32));
        }
        layout
    }
}

/// A panel of a [`stack`].
pub struct Panel {
    /// The chart that is shown.
    pub chart: Chart,
    /// Lowest and highest y of the axis, in the unit of the curves.
    pub y_range: (f64, f64),
    /// Height of the axes (px).
    pub height: f64,
}

/// Width of a [`stack`] (px), which can be read on a phone.
const STACK_WIDTH: f64 = 760.0;
const STACK_LETTERS: f64 = 1.3;
/// Least range of the x axis of a [`stack`], in the unit of the axis.
const X_RANGE_MIN: f64 = 1e-3;

/// Panels below each other that share the x axis, with one legend for all at the bottom.
pub fn stack(title: &str, (from, to): (f64, f64), mut panels: Vec<Panel>) -> String {
    // An instant has no width.
    let x_range = if to > from { (from, to) } else { (from, from + X_RANGE_MIN.max(from.abs() * f64::EPSILON * 4.0)) };
    let legend = Legend::of(panels.iter_mut().map(|panel| &mut panel.chart));
    let rows = panels.len();
    let mut figure = Figure::new(rows, 1).with_title(title).with_title_size((16.0 * STACK_LETTERS) as u32);
    figure = figure.with_cell_size(STACK_WIDTH, 200.0).with_spacing(2.0).with_shared_x_all();
    let (mut plots, mut layouts) = (Vec::new(), Vec::new());
    for (row, Panel { mut chart, y_range, height }) in panels.into_iter().enumerate() {
        let is_last = row + 1 == rows;
        let below = if is_last { (MARGIN_BOTTOM + legend.height()) * STACK_LETTERS } else { 8.0 };
        figure = figure.with_row_height(row, 6.0 + height + below);
        let layout = chart
            .layout(x_range, y_range, STACK_LETTERS)
            .with_force_margins(MARGIN_LEFT * STACK_LETTERS, MARGIN_RIGHT)
            .with_force_margins_y(6.0, below);
        layouts.push(if is_last { legend.clone().below(layout) } else { layout });
        plots.push(chart.plots);
    }
    svg(&figure.with_plots(plots).with_layouts(layouts).render())
}

/// A chart of a [`maps`] picture.
pub struct Map {
    /// The chart that is shown.
    pub chart: Chart,
    /// Scale of both axes (px/m).
    pub scale: f64,
}

impl Map {
    /// Least and greatest x, least and greatest y, with a margin around all that was drawn.
    fn ranges(&self) -> [Point; 2] {
        let [min, max] = self.chart.extent();
        let pad = 0.05 * (max[0] - min[0]).min(max[1] - min[1]) + 8.0 / self.scale;
        [[min[0] - pad, max[0] + pad], [min[1] - pad, max[1] + pad]]
    }
}

/// Charts to scale, below each other, with one legend for all at the bottom.
pub fn maps(title: &str, mut maps: Vec<Map>) -> String {
    for map in &mut maps {
        map.scale = map.scale.min(MAP_SIZE_MAX / map.chart.span());
    }
    let inner: Vec<Point> =
        maps.iter().map(|map| map.ranges().map(|[least, greatest]| (greatest - least) * map.scale)).collect();
    let width = inner.iter().map(|[width, _]| *width).fold(MAP_WIDTH_MIN, f64::max);
    let letters = (width / WIDTH_OF_SCALE_1).max(1.0);
    let legend = Legend::of(maps.iter_mut().map(|map| &mut map.chart));
    let rows = maps.len();
    let sides = [MARGIN_LEFT, MARGIN_RIGHT].map(|margin| margin * letters);
    let mut figure = Figure::new(rows, 1).with_title(title).with_title_size((16.0 * letters) as u32);
    figure = figure.with_col_width(0, width + sides[0] + sides[1]);
    let (mut plots, mut layouts) = (Vec::new(), Vec::new());
    for (row, (mut map, [_, height])) in maps.into_iter().zip(inner).enumerate() {
        let is_last = row + 1 == rows;
        let legend_height = if is_last { legend.height() } else { 0.0 };
        let [above, below] = [MARGIN_TOP * letters, (MARGIN_BOTTOM + legend_height) * letters];
        figure = figure.with_row_height(row, height + above + below);

        // The axes fill the cell, with the drawing in its middle.
        let [x, y] = map.ranges();
        let fill = |[least, greatest]: Point, pixels: f64| {
            let (middle, half) = ((least + greatest) / 2.0, pixels / map.scale / 2.0);
            (middle - half, middle + half)
        };
        let [x_step, y_step] = TICK_DISTANCE_MIN.map(|least| round_step(least * letters / map.scale));
        map.chart.widen_lines(letters);
        let layout = map
            .chart
            .layout(fill(x, width), fill(y, height), letters)
            .with_force_margins(sides[0], sides[1])
            .with_force_margins_y(above, below)
            .with_x_tick_step(x_step)
            .with_y_tick_step(y_step)
            .with_equal_aspect();
        layouts.push(if is_last { legend.clone().below(layout) } else { layout });
        plots.push(map.chart.plots);
    }
    svg(&figure.with_plots(plots).with_layouts(layouts).render())
}

/// The legend of all charts of a picture; a label that several of them share is listed once.
#[derive(Clone)]
struct Legend(Vec<LegendEntry>);

impl Legend {
    fn of<'c>(charts: impl Iterator<Item = &'c mut Chart>) -> Self {
        let mut entries: Vec<LegendEntry> = Vec::new();
        for entry in charts.flat_map(|chart| std::mem::take(&mut chart.legend)) {
            if entries.iter().all(|listed| listed.label != entry.label) {
                entries.push(entry);
            }
        }
        Self(entries)
    }

    /// Height of the legend below the axis label (px at scale 1).
    fn height(&self) -> f64 {
        match self.0.len().div_ceil(self.columns()) {
            0 => 0.0,
            lines => lines as f64 * LEGEND_LINE + LEGEND_SPACE,
        }
    }

    fn columns(&self) -> usize {
        let is_long = |entry: &LegendEntry| entry.label.chars().count() > LEGEND_LABEL_MAX;
        if self.0.iter().any(is_long) { 1 } else { LEGEND_COLUMNS }
    }

    fn below(self, layout: Layout) -> Layout {
        if self.0.is_empty() {
            return layout;
        }
        let columns = self.columns();
        let layout = layout.with_legend_entries(self.0).with_legend_box(false).with_legend_col_limit(columns);
        layout.with_legend_position(LegendPosition::OutsideBottomColumns)
    }
}

/// Whether a point is finite, and not so far off that all else would shrink to a dot.
fn can_be_drawn(point: &Point) -> bool {
    point.iter().all(|coordinate| coordinate.abs() <= FAR)
}

fn svg(scene: &Scene) -> String {
    SvgBackend::new().render_scene(scene)
}

/// The least of …, 0.1, 0.2, 0.5, 1, 2, 5, 10, … that is not below `least`.
fn round_step(least: f64) -> f64 {
    let decade = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|step| step * decade).find(|step| *step >= least * 0.999).unwrap_or(decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of the first filled polygon in a picture (px).
    fn polygon(svg: &str) -> Vec<Point> {
        let path = svg.split("<path d=\"").find(|path| path.starts_with('M')).expect("a path");
        let numbers = path.split('"').next().unwrap_or_default().split(|c: char| !(c.is_ascii_digit() || c == '.'));
        let numbers: Vec<f64> = numbers.filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect();
        numbers.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    #[test]
    fn map_is_to_scale_in_both_directions() {
        for (far, scale) in [([0.5, 0.1], 400.0), ([9.0, 2.0], 150.0), ([1.0, 30.0], 110.0)] {
            let mut chart = Chart::new("x [m]", "y [m]");
            let sole = [[0.21, -0.04], [0.21, 0.04], [-0.07, 0.04], [-0.07, -0.04]];
            chart.polygon(&sole, Pen::solid("#000000", 1.0), 0.5);
            chart.line([[0.0, 0.0], far], Pen::solid("#000000", 1.0));
            let corners = polygon(&maps("t", vec![Map { chart, scale }]));
            let side = |axis: usize| {
                let of = |corner: &Point| corner[axis];
                corners.iter().map(of).fold(f64::MIN, f64::max) - corners.iter().map(of).fold(f64::MAX, f64::min)
            };
            // Pixels are written with two decimals.
            assert!((side(0) - 0.28 * scale).abs() < 0.03, "{} px long at {scale} px/m", side(0));
            assert!((side(1) - 0.08 * scale).abs() < 0.03, "{} px wide at {scale} px/m", side(1));
        }
    }

    #[test]
    fn line_of_a_chart_has_a_gap_at_a_missing_value() {
        let mut chart = Chart::new("x", "y");
        chart.line([[0.0, 0.0], [1.0, 0.0], [2.0, f64::NAN], [3.0, 0.0], [4.0, 0.0]], Pen::solid("#000000", 1.0));
        assert_eq!(chart.plots.len(), 2);
    }
}
