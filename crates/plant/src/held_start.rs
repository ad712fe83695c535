//! The robot is held where it begins until a controller begins there.
//!
//! A controller that commands another posture would throw the robot over, and one that only keeps the joints where they
//! are, as after a fall, balances nothing.

use interface::Setpoint;
use model::JointVector;

use crate::RobotState;

/// Largest differences of a setpoint from the initial posture (rad) and its rates (rad/s) with which the robot is let
/// go.
const RELEASE_TOLERANCE: [f64; 2] = [0.05, 0.3];

/// The posture in which a robot is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldStart {
    initial: Setpoint,
}

impl HeldStart {
    /// Held in the posture of `robot`.
    pub fn of(robot: &RobotState) -> Self {
        Self { initial: Setpoint { angles: robot.angles, rates: robot.rates, ..Setpoint::default() } }
    }

    /// The setpoint that the robot has while it is held.
    pub fn setpoint(&self) -> Setpoint {
        self.initial
    }

    /// Whether a setpoint begins where the robot is held, so that it can be let go.
    pub fn is_released_by(&self, setpoint: &Setpoint) -> bool {
        let only_holds = setpoint.rates == JointVector::ZERO && setpoint.feed_forward == JointVector::ZERO;
        let [angle, rate] = RELEASE_TOLERANCE;
        !only_holds
            && (setpoint.angles - self.initial.angles).max_abs() <= angle
            && (setpoint.rates - self.initial.rates).max_abs() <= rate
    }
}
