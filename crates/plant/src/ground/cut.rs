//! Cutting a square along straight lines into convex polygons.

use nalgebra::Vector2;

/// A cut along a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cut {
    /// Unit vector across the line (-).
    across: Vector2<f64>,
    /// Distance of the line from the world's origin along `across` (m).
    at: f64,
    /// Corners of the rectangle, least and greatest, to which it is limited; only polygons inside are cut.
    within: Option<[Vector2<f64>; 2]>,
}

/// Polygons with less area than this are left out (m²): what rounding makes of two lines in one place.
const AREA_MIN: f64 = 1e-8;

/// Points nearer to a line than this lie on it (m).
const ROUNDING: f64 = 1e-9;

impl Cut {
    /// Across a direction, at a distance from the world's origin (m).
    pub(super) fn across(direction: Vector2<f64>, at: f64) -> Self {
        Self { across: direction, at, within: None }
    }

    /// The same, limited to a rectangle with edges along x and y, given by its least and its greatest corner (m).
    pub(super) fn inside(self, rectangle: [Vector2<f64>; 2]) -> Self {
        Self { within: Some(rectangle), ..self }
    }

    /// Along the edges of a rectangle, given by its least and its greatest corner, with a rim of some width (m).
    pub(super) fn around([least, greatest]: [Vector2<f64>; 2], rim: f64) -> [Self; 4] {
        [
            Self::across(Vector2::x(), least.x - rim),
            Self::across(Vector2::x(), greatest.x + rim),
            Self::across(Vector2::y(), least.y - rim),
            Self::across(Vector2::y(), greatest.y + rim),
        ]
    }

    /// Along those lines of a square grid through `origin` that meet a square (m).
    pub(super) fn grid(origin: Vector2<f64>, spacing: f64, centre: Vector2<f64>, half_edge: f64) -> Vec<Self> {
        let lines = |across: Vector2<f64>| {
            let (origin, middle) = (origin.dot(&across), centre.dot(&across));
            let reach = half_edge * (across.x.abs() + across.y.abs());
            let [first, last] = [middle - reach, middle + reach].map(|at| (at - origin) / spacing);
            let numbers = first.ceil() as i64..=last.floor() as i64;
            numbers.map(move |number| Self::across(across, origin + number as f64 * spacing))
        };
        lines(Vector2::x()).chain(lines(Vector2::y())).collect()
    }

    /// The parts of a convex polygon on either side.
    fn split(&self, polygon: Vec<Vector2<f64>>) -> Vec<Vec<Vector2<f64>>> {
        let middle = centroid(&polygon);
        let covers = |[least, greatest]: [Vector2<f64>; 2]| {
            (least.x..greatest.x).contains(&middle.x) && (least.y..greatest.y).contains(&middle.y)
        };
        // Lines that meet in one point, but for rounding, meet in one corner.
        let beyond = |point: &Vector2<f64>| {
            let distance = self.across.dot(point) - self.at;
            if distance.abs() < ROUNDING { 0.0 } else { distance }
        };
        let is_apart =
            polygon.iter().all(|point| beyond(point) >= 0.0) || polygon.iter().all(|point| beyond(point) <= 0.0);
        if is_apart || self.within.is_some_and(|rectangle| !covers(rectangle)) {
            return vec![polygon];
        }
        let mut parts = [Vec::new(), Vec::new()];
        for (index, point) in polygon.iter().enumerate() {
            let next = &polygon[(index + 1) % polygon.len()];
            let (here, there) = (beyond(point), beyond(next));
            if here >= 0.0 {
                parts[0].push(*point);
            }
            if here <= 0.0 {
                parts[1].push(*point);
            }
            if here * there < 0.0 {
                let crossing = point + (next - point) * (here / (here - there));
                parts.iter_mut().for_each(|part| part.push(crossing));
            }
        }
        parts.into_iter().filter(|part| area(part) > AREA_MIN).collect()
    }
}

/// The polygons, counter-clockwise, that cuts leave of a square with edges along x and y (m).
pub(super) fn cut_square(centre: Vector2<f64>, half_edge: f64, cuts: &[Cut]) -> Vec<Vec<Vector2<f64>>> {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let square = corners.map(|(x, y)| centre + Vector2::new(x, y) * half_edge).to_vec();
    cuts.iter().fold(vec![square], |polygons, cut| polygons.into_iter().flat_map(|each| cut.split(each)).collect())
}

/// Centroid of a convex polygon (m).
pub(super) fn centroid(polygon: &[Vector2<f64>]) -> Vector2<f64> {
    let mut sum = Vector2::zeros();
    let mut weight = 0.0;
    for pair in polygon.windows(2).skip(1) {
        let area = (pair[0] - polygon[0]).perp(&(pair[1] - polygon[0]));
        sum += (polygon[0] + pair[0] + pair[1]) * (area / 3.0);
        weight += area;
    }
    sum / weight
}

fn area(polygon: &[Vector2<f64>]) -> f64 {
    let fan = polygon.windows(2).skip(1).map(|pair| (pair[0] - polygon[0]).perp(&(pair[1] - polygon[0])));
    fan.sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_cut_square_fill_it() {
        let mut cuts = Cut::grid(Vector2::zeros(), 0.3, Vector2::new(3.0, 1.0), 1.0);
        cuts.push(Cut::across(Vector2::new(0.6, 0.8), 2.5));
        cuts.push(Cut::across(Vector2::x(), 3.0));
        let parts = cut_square(Vector2::new(3.0, 1.0), 1.0, &cuts);
        let whole: f64 = parts.iter().map(|part| area(part)).sum();
        assert!((whole - 4.0).abs() < 1e-6, "{whole}");
        assert!(parts.len() > 49, "{}", parts.len());
        for part in &parts {
            let convex = (0..part.len()).all(|index| {
                let [a, b, c] = [0, 1, 2].map(|next| part[(index + next) % part.len()]);
                (b - a).perp(&(c - b)) > -1e-12
            });
            assert!(convex, "{part:?}");
        }
    }

    #[test]
    fn a_limited_cut_leaves_what_is_outside() {
        let rectangle = [Vector2::new(-1.0, -1.0), Vector2::new(0.0, 1.0)];
        let limited = Cut::across(Vector2::y(), 0.2).inside(rectangle);
        let parts = cut_square(Vector2::zeros(), 1.0, &[Cut::across(Vector2::x(), 0.0), limited]);
        assert_eq!(parts.len(), 3);
    }
}
