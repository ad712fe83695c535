//! The simulated robot: a floating tree with motors, soles that touch the ground, and sensors.
//!
//! [`Plant::step`] advances one control period in equal integration steps. Each step is linearly implicit: the stiff
//! forces (contact springs and dampers, joint servos) are evaluated at its *end*, which costs no more than adding their
//! stiffness to the articulated inertias and lets a stiff sole be integrated at a quarter of a millisecond. There is no
//! clock here: whoever calls decides when.

mod contact;
mod motor;
mod parameters;
mod robot;
mod sensors;
mod step;

pub use contact::{FootContact, FootMotion, GroundContact};
pub use motor::{Drive, DriveTorque};
pub use parameters::{ContactParameters, Parameters, SensorParameters, ServoParameters};
pub use robot::RobotState;
pub use sensors::{Measurement, Sensors};
pub use step::{Plant, Setpoint, Truth};
