//! Coordinate frames, described once.
//!
//! * **world**: fixed to the floor, z up; x is the heading of the robot at the start.
//! * **support**: origin O on the floor under the ankle of the support foot, x along that foot, z up. The code always
//!   stands on the *right* foot: when the left one is the support foot, support coordinates are mirrored in y.
//! * **sole**: origin on a sole under its ankle, x forward, z up when the foot is flat.
//! * **link**: origin on the joint that carries the link; parallel to the world at zero angles.
//!
//! `foot_to_world` takes foot coordinates and gives world coordinates, so that
//! `point_in_world = foot_to_world * point_in_foot` can be checked by eye.

use nalgebra::Vector3;

use crate::{Mirror, Mirrored};

/// Standard gravity (m/s²), pointing down.
pub const GRAVITY: f64 = 9.80665;

/// A wrench: a force, and a moment about an origin, both expressed in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// The force (N).
    pub force: Vector3<f64>,
    /// The moment about the origin (N·m).
    pub moment: Vector3<f64>,
}

impl Wrench {
    /// No force, no moment.
    pub const ZERO: Wrench = Wrench { force: Vector3::new(0.0, 0.0, 0.0), moment: Vector3::new(0.0, 0.0, 0.0) };

    /// The wrench of a force (N) that acts at a point (m).
    #[inline]
    pub fn at_point(force: Vector3<f64>, point: Vector3<f64>) -> Self {
        Self { force, moment: point.cross(&force) }
    }

    /// The same wrench about another origin, whose position relative to the present origin is `origin` (m).
    #[inline]
    pub fn about(&self, origin: Vector3<f64>) -> Self {
        Self { force: self.force, moment: self.moment - origin.cross(&self.force) }
    }

    /// Whether no component is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        self.force.iter().chain(self.moment.iter()).all(|value| value.is_finite())
    }
}

impl Mirrored for Wrench {
    /// A force keeps x and z, a moment keeps y.
    fn mirrored(&self, _: &Mirror) -> Self {
        Self {
            force: Vector3::new(self.force.x, -self.force.y, self.force.z),
            moment: Vector3::new(-self.moment.x, self.moment.y, -self.moment.z),
        }
    }
}

impl std::ops::Add for Wrench {
    type Output = Wrench;

    #[inline]
    fn add(self, other: Wrench) -> Wrench {
        Wrench { force: self.force + other.force, moment: self.moment + other.moment }
    }
}

impl std::ops::Sub for Wrench {
    type Output = Wrench;

    #[inline]
    fn sub(self, other: Wrench) -> Wrench {
        Wrench { force: self.force - other.force, moment: self.moment - other.moment }
    }
}

impl std::ops::Mul<f64> for Wrench {
    type Output = Wrench;

    #[inline]
    fn mul(self, factor: f64) -> Wrench {
        Wrench { force: self.force * factor, moment: self.moment * factor }
    }
}
