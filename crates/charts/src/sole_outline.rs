//! Soles on the floor, to scale.

use model::{Mechanism, Side};
use nalgebra::{Isometry3, Point3};

use super::chart::{Chart, Pen, Point};
use super::colours::colour;

/// The corners of the sole on `side` from above (m).
pub fn sole_outline(mechanism: &Mechanism, side: Side, sole_to_world: &Isometry3<f64>) -> [Point; 4] {
    mechanism.sole.corners(side).map(|corner| {
        let corner = sole_to_world * Point3::from(corner);
        [corner.x, corner.y]
    })
}

/// Draws a sole in its side's colour, with a small cross under the ankle.
pub fn draw_sole(chart: &mut Chart, mechanism: &Mechanism, side: Side, sole_to_world: &Isometry3<f64>) {
    let pen = Pen::solid(colour(side), 1.0);
    chart.polygon(&sole_outline(mechanism, side, sole_to_world), pen, 0.16);
    let arm = mechanism.sole.half_size().y / 5.0;
    for [x, y] in [[arm, 0.0], [0.0, arm]] {
        let ends = [Point3::new(-x, -y, 0.0), Point3::new(x, y, 0.0)].map(|end| sole_to_world * end);
        chart.line(ends.map(|end| [end.x, end.y]), pen);
    }
}

/// Draws an arrow head: a triangle `size` long that points along `direction` with its tip at `tip`.
pub fn draw_arrow_head(chart: &mut Chart, tip: Point, direction: Point, size: f64, colour: &'static str) {
    let length = direction[0].hypot(direction[1]);
    if length == 0.0 {
        return;
    }
    let [x, y] = direction.map(|component| component / length * size);
    let base = [tip[0] - x, tip[1] - y];
    let wing = [-0.35 * y, 0.35 * x];
    let corners = [tip, [base[0] + wing[0], base[1] + wing[1]], [base[0] - wing[0], base[1] - wing[1]]];
    chart.polygon(&corners, Pen::solid(colour, 0.3), 1.0);
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_3;

    use config::Config;
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn outline_of_a_rotated_sole_has_its_size_and_position() {
        let mechanism = Mechanism::load(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let pose = Isometry3::new(Vector3::new(2.0, -1.0, 0.0), Vector3::z() * FRAC_PI_3);
        let corners = sole_outline(&mechanism, Side::Right, &pose);
        let side = |a: usize, b: usize| (corners[a][0] - corners[b][0]).hypot(corners[a][1] - corners[b][1]);
        assert!((side(0, 1) - 0.08).abs() < 1e-12 && (side(1, 2) - 0.28).abs() < 1e-12, "{corners:?}");
        // The middle of the toe edge is 0.21 m ahead of the ankle, in the foot's direction.
        let toe = [(corners[0][0] + corners[1][0]) / 2.0, (corners[0][1] + corners[1][1]) / 2.0];
        let expected = [2.0 + 0.21 * FRAC_PI_3.cos(), -1.0 + 0.21 * FRAC_PI_3.sin()];
        assert!((toe[0] - expected[0]).hypot(toe[1] - expected[1]) < 1e-12, "{toe:?} instead of {expected:?}");
    }
}
