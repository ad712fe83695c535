//! A mass that the robot carries and its controller knows nothing of.

use dynamics::{ArticulatedBody, LinkLoad};
use model::Wrench;
use nalgebra::Vector3;

use crate::contact::point_inertia;
use crate::robot::TRUNK;

/// A point mass fixed to the trunk; none by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Payload {
    /// [kg]
    pub mass: f64,
    /// In the trunk's frame, whose origin is the waist joint [m].
    pub at: Vector3<f64>,
}

impl Payload {
    /// What it does to the trunk: gravity and inertia of a point, `m·(g − a)`.
    pub(crate) fn load(&self, body: &ArticulatedBody) -> LinkLoad {
        let point = body.kinematics.origin[TRUNK] + body.kinematics.rotation[TRUNK] * self.at;
        let angular = body.velocity[TRUNK].fixed_rows::<3>(0).into_owned();
        let linear = body.velocity[TRUNK].fixed_rows::<3>(3).into_owned();
        // What the point accelerates by when the trunk's spatial acceleration is zero.
        let centripetal = angular.cross(&(linear + angular.cross(&point)));
        LinkLoad {
            link: TRUNK,
            wrench: Wrench::at_point((body.gravity - centripetal) * self.mass, point),
            added_inertia: point_inertia(point, Vector3::repeat(self.mass)),
        }
    }
}
