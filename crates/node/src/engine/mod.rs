//! External physics engines: other programs that compute the robot's physics for the plant.
//!
//! An engine is a process that communicates through its stdin and stdout. It receives the robot as one line of JSON and
//! then one setpoint per control period, with a floor where the robot has come to new
//! ground, which it answers with a state (little-endian doubles, see
//! `tools/mujoco_plant/plant/protocol.py`). Services, clock, sensors, faults and recording stay here, so that both
//! plants differ in nothing but physics, and a run in lockstep depends on nothing but its inputs.

mod engine_error;
mod engine_setup;
mod environment;
mod external_engine;
mod external_physics;
mod laid_floor;
mod message;
mod mujoco_program;
mod text_hash;
mod urdf_setup;

pub use engine_error::EngineError;
pub use engine_setup::EngineSetup;
pub use environment::{EnvironmentError, cache, is_installed, mujoco, python};
pub use external_engine::ExternalEngine;
pub use external_physics::ExternalPhysics;
