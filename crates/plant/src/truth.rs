//! The true state of the simulated robot, which no sensor measures.

use dynamics::zmp;
use model::{Mechanism, Side};
use nalgebra::{Isometry3, Vector2, Vector3};

use crate::Plant;
use crate::robot_sized::{FALLEN_HEIGHT_SHARE, FALLEN_TILT};

/// The true state of the simulated robot. The x and y axes of the world lie in the plane of the floor,
/// whatever its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Poses of the right and the left sole: each maps sole coordinates to world coordinates.
    pub soles: [Isometry3<f64>; 2],
    /// Force on the right and on the left sole, normal to the plane of the floor (N).
    pub loads: [f64; 2],
    /// Centre of mass of robot and payload in the world (m).
    pub com: Vector3<f64>,
    /// Velocity of the centre of mass in the world (m/s); a push changes it at once, by impulse over mass.
    pub com_velocity: Vector3<f64>,
    /// Zero-moment point of the whole ground reaction, at the height of the floor under the centre of mass, in the
    /// world (m); `None` in the air.
    pub zmp: Option<Vector2<f64>>,
    /// Angle of the trunk's long axis against the true vertical (rad).
    pub trunk_tilt: f64,
    /// Height of the floor under the centre of mass (m).
    pub floor_height: f64,
    /// Height of the centre of mass above the floor when the robot stands straight (m).
    pub standing_height: f64,
}

impl Truth {
    /// Whether the robot has fallen or is past recovery: its trunk is tilted by more than 60°, or its centre of mass is
    /// lower over the floor than 0.453 of its height when the robot stands straight.
    pub fn has_fallen(&self) -> bool {
        let height = self.com.z - self.floor_height;
        !(self.trunk_tilt < FALLEN_TILT && height > FALLEN_HEIGHT_SHARE * self.standing_height)
    }
}

impl Plant {
    /// The true state at this instant.
    pub fn truth(&self) -> Truth {
        let kinematics = self.robot.kinematics(&self.tree);
        let base = self.robot.sole_to_world.translation.vector;
        let trunk_axis = kinematics.link_to_world(Mechanism::TRUNK).rotation * Vector3::z();
        let (com, com_velocity) = self.com(&kinematics);
        let floor_height = self.floor.height(com.xy());
        let total = (self.ground[0] + self.ground[1]).about(Vector3::new(0.0, 0.0, floor_height - base.z));
        Truth {
            soles: Side::BOTH.map(|side| kinematics.sole_to_world(&self.mechanism, side)),
            loads: self.ground.map(|foot| foot.force.z),
            com,
            com_velocity,
            zmp: zmp(&total).map(|point| point + base.xy()),
            floor_height,
            standing_height: self.standing_height,
            trunk_tilt: libm::acos(trunk_axis.dot(&self.parameters.slope.up()).clamp(-1.0, 1.0)),
        }
    }

    /// Centre of mass of robot and payload in the world (m) and its velocity (m/s).
    fn com(&self, kinematics: &dynamics::Kinematics) -> (Vector3<f64>, Vector3<f64>) {
        let payload = &self.parameters.payload;
        let (com, velocity) = self.robot.com(&self.tree, kinematics);
        let place = kinematics.origin[Mechanism::TRUNK] + kinematics.rotation[Mechanism::TRUNK] * payload.at;
        let (_, moves) = self.robot.link_velocity(&self.tree, &self.mechanism, kinematics, Mechanism::TRUNK, place);
        let share = payload.mass / (self.tree.mass + payload.mass);
        (com + (place - com) * share, velocity + (moves - velocity) * share)
    }
}
