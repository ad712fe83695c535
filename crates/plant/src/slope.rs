//! A sloping floor.
//!
//! The floor stays the plane z = 0 of the plant's world, and the vertical tilts instead. The physics are the same, and
//! the contact needs no special case.

use config::Table;
use model::GRAVITY;
use nalgebra::{UnitQuaternion, Vector3};

/// Steepest floor that a file may have (deg): far steeper than a robot can stand on.
const SLOPE_MAX_DEG: f64 = 40.0;

/// Slope of the floor; table `[slope]` of `config/plant.toml`. The x and y axes of the world lie in the floor, z is
/// normal to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slope {
    /// Elevation of the world's x axis over the horizontal (rad).
    pub ahead: f64,
    /// Elevation of the world's y axis over the horizontal (rad).
    pub left: f64,
}

impl Slope {
    /// Reads the table `[slope]`.
    pub(crate) fn read(table: &Table) -> Self {
        Self {
            ahead: table.angle("ahead_deg").between(-SLOPE_MAX_DEG, SLOPE_MAX_DEG),
            left: table.angle("left_deg").between(-SLOPE_MAX_DEG, SLOPE_MAX_DEG),
        }
    }

    /// The true vertical, upward, in world axes.
    pub fn up(&self) -> Vector3<f64> {
        if *self == Self::default() {
            return Vector3::z();
        }
        let (x, y) = (libm::sin(self.ahead), libm::sin(self.left));
        Vector3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
    }

    /// Acceleration of free fall in world axes (m/s²).
    pub fn gravity(&self) -> Vector3<f64> {
        -self.up() * GRAVITY
    }

    /// Maps world axes to level axes, whose z is the true vertical. It is the shortest such rotation, so that it adds
    /// no heading.
    pub fn world_to_level(&self) -> UnitQuaternion<f64> {
        if *self == Self::default() {
            return UnitQuaternion::identity();
        }
        UnitQuaternion::rotation_between(&self.up(), &Vector3::z()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In level axes, the floor's x and y axes rise by the slope and keep their headings.
    #[test]
    fn the_floors_axes_rise_by_the_slope_and_keep_their_headings() {
        let (ahead, left) = (3.0_f64.to_radians(), -2.0_f64.to_radians());
        for slope in [Slope { ahead, left }, Slope { ahead, left: 0.0 }, Slope { ahead: 0.0, left }] {
            let to_level = slope.world_to_level();
            let (x, y) = (to_level * Vector3::x(), to_level * Vector3::y());
            assert!((x.z.asin() - slope.ahead).abs() < 1e-12);
            assert!((y.z.asin() - slope.left).abs() < 1e-12);
            // A slope both ways shears the headings by half its product, 0.05° here.
            let shear = (slope.ahead * slope.left).abs() / 2.0 + 1e-5 * slope.left.abs() + 1e-12;
            assert!(x.y.abs() <= shear && y.x.abs() <= shear, "{x} {y}");
            assert!((to_level * slope.gravity() - Vector3::new(0.0, 0.0, -GRAVITY)).norm() < 1e-12);
        }
    }
}
