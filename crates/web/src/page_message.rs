//! What a page says to begin a walk, and what it is told beside the messages of `halfstep view`.

use interchange::import::NamedText;
use serde::{Deserialize, Serialize};

/// How a walk is to begin.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Beginning {
    /// Who walks.
    pub robot: ChosenRobot,
    /// Seed of sensor noise and mass errors.
    #[serde(default)]
    pub seed: u64,
}

/// Who walks.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ChosenRobot {
    /// A robot in the box, by its name.
    InTheBox(String),
    /// A robot from its URDF.
    Urdf {
        /// The description.
        urdf: NamedFile,
        /// What a URDF lacks, as for `halfstep import --map`.
        map: Option<NamedFile>,
    },
}

/// A file that a page has read.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedFile {
    /// Its name, for errors.
    pub name: String,
    /// What it says.
    pub text: String,
}

impl NamedFile {
    /// As the import takes it.
    pub(crate) fn as_text(&self) -> NamedText<'_> {
        NamedText { text: &self.text, file: &self.name }
    }
}

/// A message to the page, beside those of `halfstep view`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum WalkNews<'a> {
    /// There is no walk, or it cannot go on, in words.
    Problem(&'a str),
    /// What the import of a URDF found, assumed and changed.
    Imported(&'a [String]),
    /// How far the walk is.
    Walked {
        /// Control periods.
        ticks: u64,
        /// Of all setpoints.
        hash: String,
        /// The commands so far, as a file for `halfstep walk --commands`.
        commands: &'a str,
        /// The pushes so far, as a file for `halfstep walk --disturbances`.
        disturbances: &'a str,
    },
}

impl WalkNews<'_> {
    /// The message as a text.
    pub fn text(&self) -> String {
        // Nothing in it could fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}
