//! The position servos of the drives: the one fact about their stiffness, for the controller and for the plant.

use crate::Joint;

/// A drive's position servo, seen at the joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// Torque per deviation of the angle (N·m/rad).
    pub stiffness: f64,
    /// Torque per deviation of the rate (N·m·s/rad).
    pub damping: f64,
}

/// The servos of all drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servos {
    /// Those of the joints that carry the robot.
    pub legs_and_waist: Servo,
    /// Those of the arms.
    pub arms: Servo,
}

impl Servos {
    /// The servo of a joint's drive.
    pub fn of(&self, joint: Joint) -> &Servo {
        if joint.is_in_arm() { &self.arms } else { &self.legs_and_waist }
    }
}
