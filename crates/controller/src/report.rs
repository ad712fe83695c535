//! What a tick gives: the setpoint, and what there is to say about it.

use gait::{Admission, HalfStep};
use model::JointVector;
use nalgebra::Vector2;

use crate::{Faults, Intent, Mode, Outranked};

/// What the drives are to reach at the end of the period, in physical joints.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// [rad]
    pub angles: JointVector,
    /// [rad/s]
    pub rates: JointVector,
    /// Torques that the motion is expected to need [N·m].
    pub feed_forward: JointVector,
}

/// One tick, told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TickReport {
    /// What goes to the drives.
    pub setpoint: Setpoint,
    /// What the controller is doing.
    pub mode: Mode,
    /// Which half-step, on which foot, how far.
    pub half_step: HalfStep,
    /// What is in force.
    pub command: gait::Command,
    /// The speed factor of this instant.
    pub speed: f64,
    /// Measured ZMP in support coordinates [m], if the ground said where.
    pub zmp_in_support: Option<Vector2<f64>>,
    /// What the asked motion needs the ZMP to be, in support coordinates [m].
    pub zmp_planned: Vector2<f64>,
    /// Signed distance of the measured ZMP to the edge of what bears [m].
    pub margin: f64,
    /// Feedback angles at the bearing ankle, about x and y [rad].
    pub lean: Vector2<f64>,
    /// What is wrong.
    pub faults: Faults,
    /// The answer to the tick's request, if it had one.
    pub answer: Option<Answer>,
}

/// The answer to a request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// What became of turn, speed and extension, and when it takes effect.
    pub admission: Admission,
    /// What is intended from now on.
    pub intent: Intent,
    /// Why nothing was granted at all, apart from the values themselves.
    pub refusal: Option<Refusal>,
}

/// Why a request as a whole was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// The robot has fallen.
    Fallen,
    /// The plain sum of modifications has been stopped; it cannot begin again from a stand.
    Standing,
    /// A source that goes before the one that asked is in command.
    Outranked(Outranked),
}
