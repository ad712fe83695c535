//! Where the centre of mass is and how it moves: from joints for the shape, from the IMU for the tilt of it all.

use dynamics::{Kinematics, Tree};
use model::{GRAVITY, JointVector};
use nalgebra::{Vector2, Vector3};

use crate::Sensed;
use crate::sensed::TRUNK;

/// The centre of mass against the bearing sole, in axes that are level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentreOfMass {
    /// [m]
    pub position: Vector3<f64>,
    /// [m/s]
    pub velocity: Vector3<f64>,
}

impl CentreOfMass {
    /// With the bearing sole flat and at rest.
    pub fn of_motion(tree: &Tree, kinematics: &Kinematics, rates: &JointVector) -> Self {
        Self { position: kinematics.com(tree), velocity: kinematics.com_velocity(tree, rates).0 }
    }

    /// As sensed. Joints and drives give way, and the sole may tip: the IMU tells by how much the whole robot leans beyond
    /// what its joints say.
    pub fn sensed(tree: &Tree, kinematics: &Kinematics, sensed: &Sensed) -> Self {
        let trunk_to_sole = &kinematics.rotation[TRUNK];
        let position = kinematics.com(tree);
        let (velocity, link_rates) = kinematics.com_velocity(tree, &sensed.rates);

        // The rotation that levels: small, and about a horizontal axis.
        let levelling = sensed.up_over_sole(kinematics).cross(&Vector3::z());
        let sole_rate = trunk_to_sole * sensed.trunk_rate - link_rates[TRUNK];
        Self {
            position: position + levelling.cross(&position),
            velocity: velocity + levelling.cross(&velocity) + sole_rate.cross(&position),
        }
    }

    /// `ω = √(g/z)` of the pendulum at this height [rad/s].
    pub fn pendulum_rate(&self) -> f64 {
        (GRAVITY / self.position.z.max(0.1)).sqrt()
    }

    /// The divergent component of motion `c + ċ/ω`: where the robot must be stepped on to come to rest (Takenaka 2009)
    /// [m].
    pub fn divergent_component(&self) -> Vector2<f64> {
        self.position.xy() + self.velocity.xy() / self.pendulum_rate()
    }
}
