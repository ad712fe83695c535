//! The simulated robot: a floating tree with motors, soles that touch the ground, and sensors.
//!
//! [`Plant::step`] advances one control period in equal integration steps. Each step is linearly implicit: the stiff
//! forces (contact springs and dampers, joint servos) are evaluated at its *end*, which costs no more than adding their
//! stiffness to the articulated inertias and lets a stiff sole be integrated at half a millisecond. The plant has no
//! clock: the caller decides when a period begins.

mod asked_push;
mod contact;
mod disturbances;
mod external_engine;
mod floor_text;
mod ground;
mod held_drive;
mod held_motion;
mod instability;
mod loads;
mod mass_error;
mod motor;
mod normal_noise;
mod obedience;
mod parameters;
mod payload;
mod push;
mod robot;
mod robot_sized;
mod sensor_fault;
mod sensors;
mod servo_shares;
mod slope;
mod sole_point;
mod step;
mod truth;

pub use contact::{ContactParameters, FootContact, FootMotion, GroundContact};
pub use disturbances::Disturbances;
pub use external_engine::EngineState;
pub use ground::{
    FloorRamp, FloorShape, FloorStep, FrictionPatch, FrictionTiles, Ground, GroundPiece, HeightField, Surface, Touch,
    Unevenness,
};
pub use held_drive::HeldDrives;
pub use held_motion::HeldMotion;
pub use instability::Instability;
pub use mass_error::with_mass_error;
pub use motor::{Drive, DriveTorque};
pub use obedience::Obedience;
pub use parameters::PlantParameters;
pub use payload::Payload;
pub use push::Push;
pub use robot::RobotState;
pub use sensor_fault::{SensedValues, SensorFault, SensorFaultKind};
pub use sensors::{SensorParameters, Sensors};
pub use servo_shares::ServoShares;
pub use slope::Slope;
pub use step::Plant;
pub use truth::Truth;
