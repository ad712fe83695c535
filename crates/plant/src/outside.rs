//! A robot that another engine moves: the physics are theirs, sensors, faults and truth stay ours.

use model::{JointVector, Wrench};

use crate::{Measurement, Plant, RobotState};

/// What an engine made of a control period.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Where the robot is and how it moves at the end.
    pub robot: RobotState,
    /// Of the ground on the right and on the left foot in the last integration step, about the right sole's origin, in
    /// world axes.
    pub ground: [Wrench; 2],
    /// In the last integration step [N·m].
    pub motor_torques: JointVector,
}

impl Plant {
    /// Moves on by one control period, whose physics others computed, and tells what is sensed at its end.
    ///
    /// Pushes and the plant's own physics play no part; slope and payload are what truth and sensors are told by.
    pub fn adopt(&mut self, outcome: Outcome) -> Measurement {
        let Outcome { robot, ground, motor_torques } = outcome;
        self.robot = robot;
        self.ground = ground;
        self.motor_torques = motor_torques;
        self.periods += 1;
        self.measure()
    }
}
