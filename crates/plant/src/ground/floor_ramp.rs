//! Ramps: lengths over which the floor rises or falls.

use config::Table;
use nalgebra::Vector2;

use super::cut::Cut;
use super::floor_extent::{FROM_MAX, FROM_MIN, direction};

/// Steepest ramp (deg): far steeper than a robot can stand on.
const RISE_MAX_DEG: f64 = 40.0;

/// A ramp across the whole floor; beyond it the floor is level again. Table `[[floor.ramp]]` of `config/plant.toml`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorRamp {
    /// Direction along the ramp, seen from where the walk begins: a unit vector (-).
    pub direction: Vector2<f64>,
    /// Distance of its beginning from where the walk begins (m).
    pub from: f64,
    /// Angle by which it rises in this direction; negative if it falls (rad).
    pub rise: f64,
    /// Its length, level (m).
    pub length: f64,
}

impl FloorRamp {
    /// Reads a table `[[floor.ramp]]`.
    pub(super) fn read(table: &Table) -> Self {
        Self {
            direction: direction(table),
            from: table.number("from_m").between(FROM_MIN, FROM_MAX),
            rise: table.angle("rise_deg").between(-RISE_MAX_DEG, RISE_MAX_DEG),
            length: table.number("length_m").between(0.01, FROM_MAX),
        }
    }

    /// What it adds to the height of the floor at a place (m).
    pub(super) fn height(&self, place: Vector2<f64>) -> f64 {
        self.along(place).max(0.0).min(self.length) * libm::tan(self.rise)
    }

    /// What it adds to the slope of the floor at a place: height per distance along x and y (-).
    pub(super) fn slope(&self, place: Vector2<f64>) -> Vector2<f64> {
        let along = self.along(place);
        let is_on_it = along >= 0.0 && along < self.length;
        if is_on_it { self.direction * libm::tan(self.rise) } else { Vector2::zeros() }
    }

    /// Where it begins and ends.
    pub(super) fn cuts(&self) -> [Cut; 2] {
        [self.from, self.from + self.length].map(|edge| Cut::across(self.direction, edge))
    }

    fn along(&self, place: Vector2<f64>) -> f64 {
        self.direction.dot(&place) - self.from
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_rises_by_its_angle_and_is_level_before_and_after() {
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        let direction = Vector2::new(cos, sin);
        let ramp = FloorRamp { direction, from: 1.0, rise: 0.1, length: 2.0 };
        for (along, height, slope) in
            [(0.9, 0.0, 0.0), (2.0, 0.1_f64.tan(), 0.1_f64.tan()), (4.0, 2.0 * 0.1_f64.tan(), 0.0)]
        {
            let place = direction * along + Vector2::new(-direction.y, direction.x) * 3.0;
            assert!((ramp.height(place) - height).abs() < 1e-12, "{along}");
            assert!((ramp.slope(place) - direction * slope).norm() < 1e-12, "{along}");
        }
    }
}
