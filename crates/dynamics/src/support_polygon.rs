//! The support polygon: the convex hull of the contact points.

use nalgebra::Vector2;

/// Most corners of a support polygon: those of both soles.
const CORNERS_MAX: usize = 8;

/// No floor reaches farther (m).
const FAR: f64 = 1e9;

/// A convex polygon on the floor, corners counter-clockwise seen from above.
#[derive(Clone, Debug, PartialEq)]
pub struct SupportPolygon {
    corners: heapless::Vec<Vector2<f64>, CORNERS_MAX>,
}

impl SupportPolygon {
    /// The convex hull of points of the floor (m) (Andrew 1979). Points beyond the eighth are ignored: two soles have
    /// no more. A point that is nowhere, because a coordinate is not finite or beyond all floors, counts as none.
    pub fn hull(points: impl IntoIterator<Item = Vector2<f64>>) -> Self {
        let somewhere = |point: &Vector2<f64>| point.iter().all(|coordinate| coordinate.abs() <= FAR);
        let points = points.into_iter().filter(somewhere);
        let mut sorted: heapless::Vec<Vector2<f64>, CORNERS_MAX> = points.take(CORNERS_MAX).collect();
        sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));

        let mut corners = heapless::Vec::new();
        half_hull(sorted.iter(), &mut corners);
        half_hull(sorted.iter().rev(), &mut corners);
        if corners.is_empty() {
            corners.extend(sorted.first().copied());
        }
        Self { corners }
    }

    /// The corners, counter-clockwise seen from above (m).
    pub fn corners(&self) -> &[Vector2<f64>] {
        &self.corners
    }

    /// Signed distance of a point to the edge (m): positive inside, negative outside; −∞ without contact.
    pub fn margin(&self, point: Vector2<f64>) -> f64 {
        let count = self.corners.len();
        let mut inside = count > 2;
        let mut distance = f64::INFINITY;
        for index in 0..count {
            let (start, end) = (self.corners[index], self.corners[(index + 1) % count]);
            inside &= cross(end - start, point - start) >= 0.0;
            distance = distance.min(distance_to_segment(point, start, end));
        }
        if count == 0 {
            f64::NEG_INFINITY
        } else if inside {
            distance
        } else {
            -distance
        }
    }
}

/// Appends one side of the hull, without its last point, which begins the other side.
fn half_hull<'a>(points: impl Iterator<Item = &'a Vector2<f64>>, hull: &mut heapless::Vec<Vector2<f64>, CORNERS_MAX>) {
    let mut side: heapless::Vec<Vector2<f64>, CORNERS_MAX> = heapless::Vec::new();
    for &point in points {
        while let [.., a, b] = side[..]
            && cross(b - a, point - a) <= 0.0
        {
            side.pop();
        }
        // Never full: there are at most as many points as places.
        let _ = side.push(point);
    }
    side.pop();
    for corner in side {
        // Full only if rounding made a point a corner of both sides: then it is one of nearly the same.
        let _ = hull.push(corner);
    }
}

fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

fn distance_to_segment(point: Vector2<f64>, start: Vector2<f64>, end: Vector2<f64>) -> f64 {
    let along = end - start;
    let length_squared = along.norm_squared();
    let share = if length_squared > 0.0 { ((point - start).dot(&along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    (point - (start + along * share)).norm()
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::SupportPolygon;

    fn square() -> SupportPolygon {
        SupportPolygon::hull(
            [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.5, 0.5), (0.0, 1.0)].map(|(x, y)| Vector2::new(x, y)),
        )
    }

    #[test]
    fn points_inside_the_hull_are_no_corners_of_the_support_polygon() {
        assert_eq!(square().corners().len(), 4);
    }

    #[test]
    fn the_margin_is_positive_inside_zero_on_the_edge_and_negative_outside() {
        assert!((square().margin(Vector2::new(0.5, 0.4)) - 0.4).abs() < 1e-15);
        assert_eq!(square().margin(Vector2::new(1.0, 0.5)), 0.0);
        assert!((square().margin(Vector2::new(4.0, 5.0)) + 5.0).abs() < 1e-15);
    }

    #[test]
    fn the_margin_is_minus_infinity_without_contact_and_minus_the_distance_to_a_single_point() {
        assert_eq!(SupportPolygon::hull([]).margin(Vector2::zeros()), f64::NEG_INFINITY);
        let point = SupportPolygon::hull([Vector2::new(1.0, 0.0)]);
        assert_eq!(point.margin(Vector2::new(3.0, 0.0)), -2.0);
    }

    #[test]
    fn points_that_are_nowhere_count_as_none() {
        let nowhere = [f64::NAN, f64::INFINITY, -1e308, 1e10].map(|x| Vector2::new(x, 0.5));
        let corners = square().corners.into_iter().chain(nowhere).chain([Vector2::new(0.5, f64::NAN)]);
        assert_eq!(SupportPolygon::hull(corners), square());
        assert_eq!(SupportPolygon::hull(nowhere).margin(Vector2::zeros()), f64::NEG_INFINITY);
    }

    proptest::proptest! {
        #[test]
        fn the_hull_of_any_points_has_a_margin(bits: [[u64; 2]; 9], small: bool, point: [u64; 2]) {
            let number = |bits: u64| if small { (bits % 5) as f64 * 0.1 } else { f64::from_bits(bits) };
            let polygon = SupportPolygon::hull(bits.map(|bits| Vector2::from(bits.map(number))));
            polygon.margin(Vector2::from(point.map(number)));
        }
    }

    #[test]
    fn the_support_polygon_of_two_parallel_soles_is_a_hexagon() {
        let sole = |x: f64, y: f64| {
            [(0.21, -0.04), (0.21, 0.04), (-0.07, 0.04), (-0.07, -0.04)].map(|(dx, dy)| Vector2::new(x + dx, y + dy))
        };
        let polygon = SupportPolygon::hull(sole(0.0, 0.0).into_iter().chain(sole(0.25, 0.19)));
        assert_eq!(polygon.corners().len(), 6);
        assert!(polygon.margin(Vector2::new(0.125, 0.095)) > 0.0);
    }
}
