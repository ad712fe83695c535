//! What `halfstep paper` reads beside the robot: of the folder, or carried by the program where the folder has neither
//! a reading nor scenarios.

use std::path::Path;

use ::paper::{FileText, Scenario, built_in_other_axes, built_in_reading, built_in_scenarios};
use config::ConfigErrors;
use robots::BuiltInRobot;

/// Name of the file with the reading.
const READING: &str = "paper.toml";
/// Folder of the scenarios.
pub(super) const SCENARIOS: &str = "scenarios";
/// Names of the files with other readings of the axes, where the folder has them.
const OTHER_AXES: [&str; 1] = ["mechanism_other_reading.toml"];

/// The texts.
pub(super) struct PaperFiles {
    /// The reading, `paper.toml`.
    pub reading: FileText,
    /// The scenarios, in the order of their names.
    pub scenarios: Vec<FileText>,
    /// The mechanism with other readings of its axes.
    pub other_axes: Vec<FileText>,
}

impl PaperFiles {
    /// Reads the files beside a mechanism's in a folder, or takes the built-in ones.
    ///
    /// # Errors
    /// The folder has a reading or scenarios, and lacks the other or cannot be read.
    pub(super) fn of(folder: &Path, mechanism: &Path) -> Result<Self, ConfigErrors> {
        if !folder.join(READING).exists() && !folder.join(SCENARIOS).exists() {
            // Those of the paper's robot are no other reading of another one.
            let is_of_the_paper =
                config::read_text(mechanism).is_ok_and(|text| text == BuiltInRobot::of_the_paper().mechanism_text());
            return Ok(Self {
                reading: built_in_reading(),
                scenarios: built_in_scenarios(),
                other_axes: if is_of_the_paper { vec![built_in_other_axes()] } else { Vec::new() },
            });
        }
        let other_axes = OTHER_AXES.map(|name| folder.join(name));
        let other_axes = other_axes.iter().filter(|file| file.exists()).map(|file| FileText::load(file));
        Ok(Self {
            other_axes: other_axes.collect::<Result<_, _>>()?,
            reading: FileText::load(&folder.join(READING))?,
            scenarios: Scenario::texts_in(&folder.join(SCENARIOS))?,
        })
    }
}
