//! A robot that another physics engine moves: the engine computes the physics; sensors, faults and truth stay ours.

use interface::Measurement;
use model::{JointVector, Wrench};

use crate::{Plant, RobotState};

/// The state that an external engine reports at the end of a control period.
#[derive(Clone, Debug, PartialEq)]
pub struct EngineState {
    /// Pose and velocity of the robot.
    pub robot: RobotState,
    /// Wrench of the ground on the right and on the left foot over the engine's last integration step, about the right
    /// sole's origin in world axes.
    pub ground: [Wrench; 2],
    /// Torques of the motors over the engine's last integration step, at the joints (N·m).
    pub motor_torques: JointVector,
}

impl Plant {
    /// Advances by one control period whose physics an external engine has computed, and returns the measurement at its
    /// end.
    ///
    /// Pushes and the plant's own physics play no part; slope and payload are what truth and sensors are told by.
    pub fn adopt(&mut self, outcome: EngineState) -> Measurement {
        let EngineState { robot, ground, motor_torques } = outcome;
        self.robot = robot;
        self.ground = ground;
        self.motor_torques = motor_torques;
        self.periods += 1;
        self.measure()
    }
}
