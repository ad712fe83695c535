//! The physics of the simulated robot: the plant's own, or another program's.

use interface::{Measurement, Setpoint};
use model::Motion;
use plant::Plant;

use crate::engine::EngineError;

/// Computes the physics of the simulated robot.
pub trait Physics {
    /// Moves the robot on by one control period towards a setpoint, and returns the measurement at its end.
    ///
    /// # Errors
    /// The physics cannot be computed.
    fn step(&mut self, plant: &mut Plant, setpoint: &Setpoint) -> Result<Measurement, EngineError>;

    /// Takes note that the plant's robot was [placed](Plant::place) with a posture.
    ///
    /// # Errors
    /// The physics cannot be computed.
    fn place(&mut self, plant: &Plant, posture: &Motion) -> Result<(), EngineError>;
}

/// The plant's own physics.
#[derive(Clone, Copy, Debug, Default)]
pub struct OwnPhysics;

impl Physics for OwnPhysics {
    fn step(&mut self, plant: &mut Plant, setpoint: &Setpoint) -> Result<Measurement, EngineError> {
        Ok(plant.step(setpoint))
    }

    fn place(&mut self, _: &Plant, _: &Motion) -> Result<(), EngineError> {
        Ok(())
    }
}
