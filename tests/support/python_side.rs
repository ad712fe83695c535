//! The Python side, where it is installed.

use std::process::Command;

use halfstep::engine;

/// The Python of `tools/mujoco_plant/requirements.txt`. `None`, and the test says nothing, where nobody has installed it
/// with `halfstep walk --plant mujoco`; where `HALFSTEP_MUJOCO` is set, it is installed.
pub fn python() -> Option<Command> {
    if std::env::var_os("HALFSTEP_MUJOCO").is_none() && !engine::is_installed() {
        eprintln!("not run: the Python side is not installed; set HALFSTEP_MUJOCO=1 to have it installed");
        return None;
    }
    Some(engine::python().unwrap_or_else(|failure| panic!("{failure}")))
}
