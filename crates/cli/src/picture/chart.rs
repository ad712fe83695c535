//! A chart of lines and filled polygons: the only place that names kuva.

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
    /// As in HTML: `#0072B2`.
    pub colour: &'static str,
    /// Pixels at scale 1.
    pub width: f64,
    /// Whether in dashes.
    pub dashed: bool,
}

impl Pen {
    /// A continuous line.
    pub const fn solid(colour: &'static str, width: f64) -> Self {
        Self { colour, width, dashed: false }
    }

    /// A line of dashes.
    pub const fn dashed(colour: &'static str, width: f64) -> Self {
        Self { colour, width, dashed: true }
    }
}

/// Lines and polygons with axes.
pub struct Chart {
    /// Quantity and unit of the horizontal axis; empty when it is another panel's.
    pub x_label: String,
    y_label: String,
    plots: Vec<Plot>,
    legend: Vec<LegendEntry>,
    levels: Vec<ReferenceLine>,
    texts: Vec<TextAnnotation>,
    /// Of what was drawn: the corner of least x and y, and that of greatest.
    extent: Option<[Point; 2]>,
}

const DASHES: &str = "6 4";
/// Space around the axes [px at scale 1].
const MARGIN_LEFT: f64 = 78.0;
const MARGIN_RIGHT: f64 = 26.0;
const MARGIN_TOP: f64 = 12.0;
const MARGIN_BOTTOM: f64 = 52.0;
/// Width for the legend at the right of a panel [px at scale 1].
const LEGEND_WIDTH: f64 = 190.0;
/// Between the ticks of a map, at least [px at scale 1].
const TICK_DISTANCE_MIN: f64 = 60.0;
/// Canvases beyond this width get larger letters, so that they can be read when the whole is looked at [px].
const WIDTH_OF_SCALE_1: f64 = 1300.0;

impl Chart {
    /// An empty chart; the labels name quantity and unit.
    pub fn new(x_label: impl Into<String>, y_label: impl Into<String>) -> Self {
        Self {
            x_label: x_label.into(),
            y_label: y_label.into(),
            plots: Vec::new(),
            legend: Vec::new(),
            levels: Vec::new(),
            texts: Vec::new(),
            extent: None,
        }
    }

    /// A line through points; it has gaps where a point is not finite.
    pub fn line(&mut self, points: impl IntoIterator<Item = Point>, pen: Pen) {
        let points: Vec<Point> = points.into_iter().collect();
        for piece in points.split(|[x, y]| !(x.is_finite() && y.is_finite())).filter(|piece| piece.len() > 1) {
            self.include(piece);
            let style = if pen.dashed { LineStyle::Custom(DASHES.into()) } else { LineStyle::Solid };
            let line = LinePlot::new().with_data(piece.iter().map(|&[x, y]| (x, y)));
            let line = line.with_color(pen.colour).with_stroke_width(pen.width).with_line_style(style);
            self.plots.push(line.into());
        }
    }

    /// A filled polygon; `opacity` is that of the filling, from 0 to 1.
    pub fn polygon(&mut self, corners: &[Point], pen: Pen, opacity: f64) {
        self.include(corners);
        // A closed line's filling is closed over its one end, which is its start: the polygon itself.
        let closed = corners.iter().chain(corners.first()).map(|&[x, y]| (x, y));
        let outline = LinePlot::new().with_data(closed).with_color(pen.colour).with_stroke_width(pen.width);
        self.plots.push(outline.with_fill().with_fill_opacity(opacity).into());
    }

    /// A horizontal line across the whole chart.
    pub fn level(&mut self, y: f64, pen: Pen) {
        let dashes = if pen.dashed { DASHES } else { "none" };
        let line = ReferenceLine::horizontal(y).with_color(pen.colour);
        self.levels.push(line.with_stroke_width(pen.width).with_dasharray(dashes));
    }

    /// Words centred on a point.
    pub fn text(&mut self, text: impl Into<String>, [x, y]: Point) {
        self.texts.push(TextAnnotation::new(text.into(), x, y).with_color("#333333"));
    }

    /// Says in the legend what a line means.
    pub fn key_line(&mut self, label: &str, pen: Pen) {
        let dasharray = pen.dashed.then(|| DASHES.to_string());
        self.legend.push(LegendEntry {
            label: label.into(),
            color: pen.colour.into(),
            shape: LegendShape::Line,
            dasharray,
        });
    }

    /// Says in the legend what a filled area means.
    pub fn key_area(&mut self, label: &str, colour: &str) {
        let (label, color) = (label.into(), colour.into());
        self.legend.push(LegendEntry { label, color, shape: LegendShape::Rect, dasharray: None });
    }

    /// Makes room for points without drawing anything there.
    pub fn include(&mut self, points: &[Point]) {
        for &[x, y] in points {
            let [min, max] = self.extent.get_or_insert([[x, y], [x, y]]);
            *min = [min[0].min(x), min[1].min(y)];
            *max = [max[0].max(x), max[1].max(y)];
        }
    }

    /// The corner of least x and y of what was drawn, and that of greatest; the unit square when nothing was.
    pub fn extent(&self) -> [Point; 2] {
        self.extent.unwrap_or([[0.0; 2], [1.0; 2]])
    }

    /// Greater of what was drawn's width and height.
    pub fn span(&self) -> f64 {
        let [min, max] = self.extent();
        (max[0] - min[0]).max(max[1] - min[1])
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
    /// What it shows.
    pub chart: Chart,
    /// From the lowest to the highest y.
    pub y_range: (f64, f64),
    /// [px]
    pub height: f64,
}

/// Panels below each other that share the x axis.
pub fn stack(title: &str, width: f64, x_range: (f64, f64), panels: Vec<Panel>) -> String {
    let rows = panels.len();
    let mut figure =
        Figure::new(rows, 1).with_title(title).with_cell_size(width, 200.0).with_spacing(2.0).with_shared_x_all();
    let (mut plots, mut layouts) = (Vec::new(), Vec::new());
    for (row, Panel { mut chart, y_range, height }) in panels.into_iter().enumerate() {
        figure = figure.with_row_height(row, height);
        let legend = std::mem::take(&mut chart.legend);
        let chart_has_x_label = !chart.x_label.is_empty();
        let layout = chart
            .layout(x_range, y_range, 1.0)
            .with_force_margins(MARGIN_LEFT, MARGIN_RIGHT + LEGEND_WIDTH)
            .with_force_margins_y(6.0, if chart_has_x_label { MARGIN_BOTTOM } else { 8.0 })
            .with_legend_entries(legend)
            .with_legend_box(false)
            .with_legend_position(LegendPosition::OutsideRightTop);
        layouts.push(layout);
        plots.push(chart.plots);
    }
    svg(&figure.with_plots(plots).with_layouts(layouts).render())
}

/// How the maps of a [`maps`] picture are placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placed {
    /// Next to each other.
    Across,
    /// Below each other.
    Down,
}

/// A chart of a [`maps`] picture.
pub struct Map {
    /// What it shows.
    pub chart: Chart,
    /// Pixels per unit, of both axes alike.
    pub scale: f64,
}

impl Map {
    /// Least and greatest x, least and greatest y, with some space around what was drawn.
    fn ranges(&self) -> [Point; 2] {
        let [min, max] = self.chart.extent();
        let pad = 0.05 * (max[0] - min[0]).min(max[1] - min[1]) + 8.0 / self.scale;
        [[min[0] - pad, max[0] + pad], [min[1] - pad, max[1] + pad]]
    }
}

/// Charts to scale. Legends stand at the right.
pub fn maps(title: &str, placed: Placed, maps: Vec<Map>) -> String {
    let inner: Vec<Point> =
        maps.iter().map(|map| map.ranges().map(|[least, greatest]| (greatest - least) * map.scale)).collect();
    let widest = inner.iter().map(|[width, _]| *width).fold(0.0, f64::max);
    let letters = (widest / WIDTH_OF_SCALE_1).max(1.0);
    let legend_height = |map: &Map| (map.chart.legend.len() as f64 * 20.0 + 16.0) * letters;
    let tallest = inner.iter().zip(&maps).map(|(inner, map)| inner[1].max(legend_height(map))).fold(0.0, f64::max);
    let any_legend = maps.iter().any(|map| !map.chart.legend.is_empty());

    let (rows, columns) = match placed {
        Placed::Across => (1, maps.len()),
        Placed::Down => (maps.len(), 1),
    };
    let mut figure = Figure::new(rows, columns).with_title(title).with_title_size((18.0 * letters) as u32);
    let (mut plots, mut layouts) = (Vec::new(), Vec::new());
    for (index, (mut map, [width, height])) in maps.into_iter().zip(inner).enumerate() {
        let has_legend = !map.chart.legend.is_empty();
        let (width, height, legend_beside) = match placed {
            Placed::Across => (width, tallest, has_legend),
            Placed::Down => (widest, height.max(legend_height(&map)), any_legend),
        };
        let right = MARGIN_RIGHT + if legend_beside { LEGEND_WIDTH } else { 0.0 };
        let sides = [MARGIN_LEFT, right, MARGIN_TOP, MARGIN_BOTTOM].map(|margin| margin * letters);
        let cell = [width + sides[0] + sides[1], height + sides[2] + sides[3]];
        figure = match placed {
            Placed::Across => figure.with_col_width(index, cell[0]).with_row_height(0, cell[1]),
            Placed::Down => figure.with_row_height(index, cell[1]).with_col_width(0, cell[0]),
        };

        // The axes take the room that the cell has; what was drawn is in its middle.
        let [x, y] = map.ranges();
        let fill = |[least, greatest]: Point, pixels: f64| {
            let (middle, half) = ((least + greatest) / 2.0, pixels / map.scale / 2.0);
            (middle - half, middle + half)
        };
        let step = round_step(TICK_DISTANCE_MIN * letters / map.scale);
        let legend = std::mem::take(&mut map.chart.legend);
        let layout = map
            .chart
            .layout(fill(x, width), fill(y, height), letters)
            .with_force_margins(sides[0], sides[1])
            .with_force_margins_y(sides[2], sides[3])
            .with_x_tick_step(step)
            .with_y_tick_step(step)
            .with_equal_aspect();
        layouts.push(if has_legend {
            layout.with_legend_entries(legend).with_legend_position(LegendPosition::OutsideRightTop)
        } else {
            layout
        });
        plots.push(map.chart.plots);
    }
    svg(&figure.with_plots(plots).with_layouts(layouts).render())
}

fn svg(scene: &Scene) -> String {
    SvgBackend::new().render_scene(scene)
}

/// The least of 1, 2, 5, 10 … (and their tenths) that is not below `least`.
fn round_step(least: f64) -> f64 {
    let decade = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|step| step * decade).find(|step| *step >= least * 0.999).unwrap_or(decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of the first filled polygon in a picture [px].
    fn polygon(svg: &str) -> Vec<Point> {
        let path = svg.split("<path d=\"").find(|path| path.starts_with('M')).expect("a path");
        let numbers = path.split('"').next().unwrap_or_default().split(|c: char| !(c.is_ascii_digit() || c == '.'));
        let numbers: Vec<f64> = numbers.filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect();
        numbers.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    #[test]
    fn a_map_is_to_scale_in_both_directions_whatever_else_it_shows() {
        for (far, scale) in [([0.5, 0.1], 400.0), ([9.0, 2.0], 150.0), ([1.0, 30.0], 110.0)] {
            let mut chart = Chart::new("x [m]", "y [m]");
            let sole = [[0.21, -0.04], [0.21, 0.04], [-0.07, 0.04], [-0.07, -0.04]];
            chart.polygon(&sole, Pen::solid("#000000", 1.0), 0.5);
            chart.line([[0.0, 0.0], far], Pen::solid("#000000", 1.0));
            let corners = polygon(&maps("t", Placed::Down, vec![Map { chart, scale }]));
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
    fn a_line_has_a_gap_where_a_value_is_missing() {
        let mut chart = Chart::new("x", "y");
        chart.line([[0.0, 0.0], [1.0, 0.0], [2.0, f64::NAN], [3.0, 0.0], [4.0, 0.0]], Pen::solid("#000000", 1.0));
        assert_eq!(chart.plots.len(), 2);
    }
}
