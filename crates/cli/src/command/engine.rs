//! The option for the physics engine.

use clap::ValueEnum;

/// Physics engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Engine {
    /// The built-in plant
    #[default]
    Rust,
    /// MuJoCo, in a separate Python process
    Mujoco,
}

impl Engine {
    /// Name of the engine on the command line.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Engine::Rust => "rust",
            Engine::Mujoco => "mujoco",
        }
    }
}
