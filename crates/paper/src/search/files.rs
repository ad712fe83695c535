//! Texts of the files that a search reads and writes.

use std::path::Path;

use config::{Config, ConfigErrors};
use model::{Joint, Mechanism};

use super::error::SearchError;
use super::toml_values::with_lines;

/// The text of a file, with its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileText {
    /// Name of the file, for messages.
    pub name: String,
    /// Its text.
    pub text: String,
}

impl FileText {
    /// Reads a file.
    ///
    /// # Errors
    /// It cannot be read, or is too long.
    pub fn load(file: &Path) -> Result<Self, ConfigErrors> {
        Ok(Self { name: file.display().to_string(), text: config::read_text(file)? })
    }
}

/// A mechanism with the text of its file.
#[derive(Clone, Debug)]
pub(super) struct MechanismFile {
    pub name: String,
    pub text: String,
    pub mechanism: Mechanism,
}

/// Texts of the files that a candidate changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FoundFiles {
    /// `mechanism.toml`.
    pub mechanism: String,
    /// `nominal_half_step.csv`.
    pub nominal: String,
    /// `paper.toml`.
    pub reading: String,
    /// All files of `scenarios`.
    pub scenarios: Vec<FileText>,
}

/// Parses a mechanism's file, with the edges of its sole as two keys.
pub(super) fn mechanism_file(file: FileText) -> Result<MechanismFile, SearchError> {
    let mechanism = Mechanism::from_toml(&file.text, &file.name)?;
    let pelvis_is_between = mechanism.links[Joint::LeftHipRoll].parent == Some(Joint::RightHipRoll);
    let is_skew = mechanism.links.iter().any(|(_, link)| link.body.principal_axes.is_some());
    if mechanism.source.is_some() || is_skew || !pelvis_is_between {
        return Err(SearchError::NotScalable { file: file.name });
    }
    let edges = format!("inside_m = {}\noutside_m = {}", mechanism.sole.inside, mechanism.sole.outside);
    let text = with_lines(&file.text, "sole", "width_m", &edges);
    Ok(MechanismFile { name: file.name, text, mechanism })
}
