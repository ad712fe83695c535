//! Physics of another program: the engine is started anew when the robot was placed by hand.

use std::process::Command;

use interface::{Measurement, Setpoint};
use model::{Joint, Motion};
use plant::{Plant, RobotState};

use super::engine_error::EngineError;
use super::engine_setup::EngineSetup;
use super::external_engine::ExternalEngine;
use crate::physics::Physics;

/// The physics of a robot that another program computes.
#[derive(Debug)]
pub struct ExternalPhysics {
    command: Command,
    setup: EngineSetup,
    engine: ExternalEngine,
}

impl ExternalPhysics {
    /// Starts an engine and sends it the setup.
    ///
    /// # Errors
    /// As for [`ExternalEngine::start`].
    pub fn start(command: Command, setup: EngineSetup) -> Result<Self, EngineError> {
        let engine = ExternalEngine::start(again(&command), &setup)?;
        Ok(Self { command, setup, engine })
    }

    /// Whether the engine's robot has a body for a link, so that it can be pushed.
    pub fn has(&self, link: Joint) -> bool {
        self.engine.has(link)
    }
}

impl Physics for ExternalPhysics {
    fn step(&mut self, plant: &mut Plant, setpoint: &Setpoint) -> Result<Measurement, EngineError> {
        self.engine.step(plant, setpoint)
    }

    fn place(&mut self, _: &Plant, posture: &Motion) -> Result<(), EngineError> {
        let setup = self.setup.clone().beginning(&RobotState::on_right_foot(posture, 0.0));
        self.engine = ExternalEngine::start(again(&self.command), &setup)?;
        Ok(())
    }
}

/// The same command once more.
fn again(command: &Command) -> Command {
    let mut same = Command::new(command.get_program());
    same.args(command.get_args());
    same
}
