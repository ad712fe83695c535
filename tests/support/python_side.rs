//! The Python side: MuJoCo, messages and recordings as others read them.

use std::process::Command;

use node::engine;

/// The Python of `tools/mujoco_plant/requirements.txt`, which is installed on first use.
///
/// Only for tests that are ignored by default: `cargo test --workspace --tests -- --ignored` runs them.
///
/// # Panics
/// If it cannot be installed, for lack of Python or of a package registry.
pub fn python() -> Command {
    engine::python().unwrap_or_else(|failure| panic!("{failure}"))
}
