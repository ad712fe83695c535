//! Twists: how a rigid body moves, as a field over space (Featherstone 2008, §2.2).

use model::Wrench;
use nalgebra::Vector3;

/// A field of velocities or accelerations `linear + angular × x`, as a rigid body has it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Twist {
    pub angular: Vector3<f64>,
    /// At the common origin.
    pub linear: Vector3<f64>,
}

impl Twist {
    /// How a wrench changes that is carried along by these velocities.
    #[inline(always)]
    pub fn turn(&self, wrench: &Wrench) -> Wrench {
        Wrench {
            force: self.angular.cross(&wrench.force),
            moment: self.angular.cross(&wrench.moment) + self.linear.cross(&wrench.force),
        }
    }
}
