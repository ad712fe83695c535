//! A map of where the robot was, seen from above with north where it first looked.

use interface::WalkPose;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;
use ratatui::symbols::Marker;
use ratatui::widgets::Widget;
use ratatui::widgets::canvas::{Canvas, Context, Line, Points};

/// Least width of the map (m).
const WIDTH_MIN: f64 = 2.0;
/// Height of a character as a ratio to its width.
const CHARACTER: f64 = 2.0;
/// Length of the line that shows the heading, as a share of the map's width.
const HEADING: f64 = 0.08;

/// The path of a robot and where it looks.
pub(crate) struct PathMap<'a> {
    pub(crate) path: &'a [[f64; 2]],
    pub(crate) pose: WalkPose,
}

impl PathMap<'_> {
    /// The part of the floor that is shown: middle and width (m), for an area so many times as wide as high.
    fn extent(&self, aspect: f64) -> ([f64; 2], f64) {
        let points = self.path.iter().copied().chain([[self.pose.x, self.pose.y]]);
        let empty = [f64::INFINITY, f64::NEG_INFINITY];
        let [x, y] = points.fold([empty; 2], |bounds, point| {
            [0, 1].map(|axis| [bounds[axis][0].min(point[axis]), bounds[axis][1].max(point[axis])])
        });
        let size = |[least, most]: [f64; 2]| (most - least) * 1.2;
        let middle = [x, y].map(|[least, most]| (least + most) / 2.0);
        (middle, size(y).max(size(x) * aspect).max(WIDTH_MIN))
    }

    /// The width of the map (m) in an area.
    pub(crate) fn width(&self, area: Rect) -> f64 {
        self.extent(aspect(area)).1
    }
}

/// How many times as wide as high an area is.
fn aspect(area: Rect) -> f64 {
    f64::from(area.width.max(1)) / (CHARACTER * f64::from(area.height.max(1)))
}

impl Widget for &PathMap<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let ([x, y], width) = self.extent(aspect(area));
        let height = width / aspect(area);
        // Ahead is up, and left is left.
        let path: Vec<(f64, f64)> = self.path.iter().map(|[x, y]| (-y, *x)).collect();
        let WalkPose { x: ahead, y: left, heading } = self.pose;
        let (sine, cosine) = heading.sin_cos();
        let length = HEADING * width;
        let paint = |context: &mut Context| {
            context.draw(&Points { coords: &path, color: Color::Blue });
            context.draw(&Line {
                x1: -left,
                y1: ahead,
                x2: -left - length * sine,
                y2: ahead + length * cosine,
                color: Color::Yellow,
            });
        };
        Canvas::default()
            .marker(Marker::Braille)
            .x_bounds([-y - width / 2.0, -y + width / 2.0])
            .y_bounds([x - height / 2.0, x + height / 2.0])
            .paint(paint)
            .render(area, buffer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_path_is_shown_and_a_short_one_not_too_large() {
        let at = |x, y| WalkPose { x, y, heading: 0.0 };
        let short = PathMap { path: &[[0.0, 0.0]], pose: at(0.0, 0.1) };
        assert_eq!(short.extent(1.0), ([0.0, 0.05], WIDTH_MIN));
        let long = PathMap { path: &[[0.0, 0.0], [10.0, 1.0]], pose: at(10.0, -3.0) };
        assert_eq!(long.extent(1.5), ([5.0, -1.0], 18.0), "12 m high and half as much again wide");
    }
}
