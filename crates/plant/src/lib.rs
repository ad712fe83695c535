//! The simulated robot: a floating tree with motors, soles that touch the ground, and sensors.
//!
//! [`Plant::step`] advances one control period in equal integration steps. Each step is linearly implicit: the stiff
//! forces (contact springs and dampers, joint servos) are evaluated at its *end*, which costs no more than adding their
//! stiffness to the articulated inertias and lets a stiff sole be integrated at half a millisecond. There is no
//! clock here: whoever calls decides when.

mod contact;
mod disturbances;
mod loads;
mod mass_error;
mod motor;
mod outside;
mod parameters;
mod payload;
mod push;
mod robot;
mod sensor_fault;
mod sensors;
mod slope;
mod step;
mod truth;
mod unevenness;

pub use contact::{FootContact, FootMotion, GroundContact};
pub use disturbances::Disturbances;
pub use mass_error::with_mass_error;
pub use motor::{Drive, DriveTorque};
pub use outside::Outcome;
pub use parameters::{ContactParameters, Parameters, SensorParameters, ServoParameters};
pub use payload::Payload;
pub use push::Push;
pub use robot::RobotState;
pub use sensor_fault::{SensedValues, SensorFault, SensorFaultKind};
pub use sensors::{Measurement, Sensors};
pub use slope::Slope;
pub use step::{Plant, Setpoint};
pub use truth::Truth;
pub use unevenness::Unevenness;
