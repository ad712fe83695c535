//! The reading: what the paper leaves open, decided once for all figures (`config/paper.toml`).

use config::{Config, Table};
use gait::RampKind;

/// How turn and step extension grow through a half-step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// Ramp of the turn.
    pub turn: RampKind,
    /// Ramp of the step extension.
    pub extension: RampKind,
}

/// The ramps with their names in files.
pub const RAMPS: [(&str, RampKind); 2] = [("linear", RampKind::Linear), ("quintic", RampKind::Quintic)];

impl Config for Reading {
    fn read(root: &Table) -> Self {
        let ramp = root.table("ramp");
        let kind = |key| ramp.choice(key, RAMPS).unwrap_or_default();
        Self { turn: kind("turn"), extension: kind("extension") }
    }
}
