//! Twists: the motion of a rigid body as a field over space (Featherstone 2008, §2.2).

use model::Wrench;
use nalgebra::Vector3;

/// The field of velocities or accelerations `linear + angular × x` of a rigid body.
#[derive(Clone, Copy, Debug)]
pub struct Twist {
    /// Angular part of the field (rad/s) or (rad/s²).
    pub angular: Vector3<f64>,
    /// Value of the field at the common origin (m/s) or (m/s²).
    pub linear: Vector3<f64>,
}

impl Twist {
    /// The field at a point.
    pub fn at(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.linear + self.angular.cross(point)
    }

    /// Rate of change of a wrench that moves along with these velocities.
    #[inline(always)]
    pub(crate) fn rate_of(&self, wrench: &Wrench) -> Wrench {
        Wrench {
            force: self.angular.cross(&wrench.force),
            moment: self.angular.cross(&wrench.moment) + self.linear.cross(&wrench.force),
        }
    }
}
