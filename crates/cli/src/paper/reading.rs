//! What the paper leaves open, decided once for all figures (`config/paper.toml`).

use std::path::Path;

use gait::RampKind;
use model::config::{self, ConfigErrors, Document};

/// How turn and extension grow through a half-step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// Of the turn.
    pub turn: RampKind,
    /// Of the step extension.
    pub extension: RampKind,
}

/// The ramps by name.
pub const RAMPS: [(&str, RampKind); 2] = [("linear", RampKind::Linear), ("quintic", RampKind::Quintic)];

impl Reading {
    /// Reads the file.
    ///
    /// # Errors
    /// When it cannot be read, and every mistake in it.
    pub fn load(file: &Path) -> Result<Self, ConfigErrors> {
        Self::from_toml(&config::read(file)?, &file.display().to_string())
    }

    /// Reads the file's text; `file` is its name for messages.
    ///
    /// # Errors
    /// Every mistake.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ConfigErrors> {
        let document = Document::parse(text, file)?;
        let ramp = document.root().table("ramp");
        let kind = |key| ramp.choice(key, RAMPS).unwrap_or_default();
        let reading = Self { turn: kind("turn"), extension: kind("extension") };
        document.finish(reading)
    }
}
