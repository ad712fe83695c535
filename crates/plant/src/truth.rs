//! What is known about the simulated robot and could not be measured.

use dynamics::zmp;
use model::Side;
use nalgebra::{Isometry3, Vector2, Vector3};

use crate::Plant;
use crate::robot::TRUNK;

/// What nobody on a real robot knows so well. World axes lie in the floor, whatever its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Right and left sole: sole to world.
    pub soles: [Isometry3<f64>; 2],
    /// Force on the right and on the left sole, normal to the floor [N].
    pub loads: [f64; 2],
    /// Centre of mass of robot and payload in the world [m].
    pub com: Vector3<f64>,
    /// Its velocity [m/s]: what a push changes at once, by impulse over mass.
    pub com_velocity: Vector3<f64>,
    /// Where the whole ground reaction acts on the floor, in the world [m]; `None` in the air.
    pub zmp: Option<Vector2<f64>>,
    /// Angle of the trunk's long axis against the true vertical [rad].
    pub trunk_tilt: f64,
    /// Height of the centre of mass when the robot stands straight [m].
    pub standing_height: f64,
}

/// A centre of mass below this share of its height when standing is a fall: 0.45 m of a human-size robot.
const FALLEN_SHARE: f64 = 0.453;

impl Truth {
    /// Whether the robot lies or is past saving: trunk tilted over 60° or its centre of mass at less than half the height at which
    /// it stands.
    pub fn has_fallen(&self) -> bool {
        !(self.trunk_tilt < std::f64::consts::FRAC_PI_3 && self.com.z > FALLEN_SHARE * self.standing_height)
    }
}

impl Plant {
    /// The truth at this instant.
    pub fn truth(&self) -> Truth {
        let kinematics = self.robot.kinematics(&self.tree);
        let base = self.robot.sole_to_world.translation.vector;
        let total = (self.ground[0] + self.ground[1]).about(Vector3::new(0.0, 0.0, -base.z));
        let trunk_axis = kinematics.link_to_world(TRUNK).rotation * Vector3::z();
        let (com, com_velocity) = self.com(&kinematics);
        Truth {
            soles: Side::BOTH.map(|side| kinematics.sole_to_world(&self.mechanism, side)),
            loads: self.ground.map(|foot| foot.force.z),
            com,
            com_velocity,
            zmp: zmp(&total).map(|point| point + base.xy()),
            standing_height: self.standing_height,
            trunk_tilt: trunk_axis.dot(&self.parameters.slope.up()).clamp(-1.0, 1.0).acos(),
        }
    }

    /// Centre of mass of robot and payload in the world [m] and its velocity [m/s].
    fn com(&self, kinematics: &dynamics::Kinematics) -> (Vector3<f64>, Vector3<f64>) {
        let payload = &self.parameters.payload;
        let (com, velocity) = self.robot.com(&self.tree, kinematics);
        let place = kinematics.origin[TRUNK] + kinematics.rotation[TRUNK] * payload.at;
        let (_, moves) = self.robot.link_velocity(&self.mechanism, kinematics, TRUNK, place);
        let share = payload.mass / (self.tree.mass + payload.mass);
        (com + (place - com) * share, velocity + (moves - velocity) * share)
    }
}
