//! Engines: who computes the robot's physics, this program or another one.
//!
//! An engine from outside is a process that speaks through its stdin and stdout: it is told the robot as one line of
//! JSON and then, per control period, a setpoint, which it answers with a state (little-endian doubles, see
//! `tools/mujoco_plant/plant.py`). Services, clock, sensors, faults and log stay here, so that both plants differ in
//! nothing but physics, and a run in lockstep depends on nothing but its inputs.

mod environment;
mod outside;
mod record;

use clap::ValueEnum;

pub use environment::{is_installed, mujoco, python};
pub use outside::{EngineError, OutsideEngine, Setup};

/// Who computes the robot's physics.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// Halfstep itself
    #[default]
    Rust,
    /// MuJoCo, in a Python process of its own
    Mujoco,
}

impl Engine {
    /// As it is written on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Engine::Rust => "rust",
            Engine::Mujoco => "mujoco",
        }
    }
}
