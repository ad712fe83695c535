//! A mass that the robot carries, unknown to the controller.

use config::Table;
use dynamics::{ArticulatedBody, LinkLoad};
use model::{Mechanism, Wrench};
use nalgebra::{Matrix3, Vector3};

use crate::contact::point_inertia;

/// A point mass fixed to the trunk; none by default. Table `[payload]` of `config/plant.toml`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Payload {
    /// Mass of the payload (kg).
    pub mass: f64,
    /// Position of the payload in the trunk's frame, whose origin is the waist joint (m).
    pub at: Vector3<f64>,
}

impl Payload {
    /// Reads the table `[payload]`.
    pub(crate) fn read(table: &Table) -> Self {
        Self { mass: table.number("mass_kg").between(0.0, 1000.0), at: table.numbers("at_m").between(-3.0, 3.0).into() }
    }

    /// The load on the trunk: gravity and inertia of a point, `m·(g − a)`.
    pub(crate) fn load(&self, body: &ArticulatedBody) -> LinkLoad {
        let point = body.kinematics.origin[Mechanism::TRUNK] + body.kinematics.rotation[Mechanism::TRUNK] * self.at;
        let angular = body.velocity[Mechanism::TRUNK].fixed_rows::<3>(0).into_owned();
        let linear = body.velocity[Mechanism::TRUNK].fixed_rows::<3>(3).into_owned();
        // Acceleration of the point at zero spatial acceleration of the trunk.
        let centripetal = angular.cross(&(linear + angular.cross(&point)));
        LinkLoad {
            link: Mechanism::TRUNK,
            wrench: Wrench::at_point((body.gravity - centripetal) * self.mass, point),
            added_inertia: point_inertia(point, Matrix3::from_diagonal_element(self.mass)),
        }
    }
}
