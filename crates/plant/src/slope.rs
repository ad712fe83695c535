//! A floor that is not level.
//!
//! The floor stays the plane z = 0 of the plant's world and the vertical tilts: the same physics, exactly, and contact
//! need not know.

use model::GRAVITY;
use nalgebra::{UnitQuaternion, Vector3};

/// How the floor rises. World axes lie in the floor, z normal to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slope {
    /// Elevation of the world's x axis over the horizontal [rad].
    pub ahead: f64,
    /// Elevation of the world's y axis over the horizontal [rad].
    pub left: f64,
}

impl Slope {
    /// The true vertical, upward, in world axes.
    pub fn up(&self) -> Vector3<f64> {
        if *self == Self::default() {
            return Vector3::z();
        }
        let (x, y) = (self.ahead.sin(), self.left.sin());
        Vector3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
    }

    /// Acceleration of free fall in world axes [m/s²].
    pub fn gravity(&self) -> Vector3<f64> {
        -self.up() * GRAVITY
    }

    /// Maps world axes to level ones, whose z is the true vertical: the shortest such rotation, so that it adds no
    /// heading.
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

    /// Looking from the level world, the floor's axes rise as the slope says and still head ahead and to the left.
    #[test]
    fn the_floors_axes_rise_as_said() {
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
