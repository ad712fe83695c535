//! A robot that can walk here, read from the texts of its configuration folder.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use config::{Config, ConfigErrors};
use gait::{NominalTable, Robot, TableFileError};
use interchange::import::NamedText;
use plant::PlantParameters;
use robots::{BuiltInRobot, ImportedRobot, ImportedRobotError};

/// A robot with everything that it needs to walk.
#[derive(Clone, Debug)]
pub struct WalkableRobot {
    /// Mechanism and nominal half-step.
    pub robot: Robot,
    /// Parameters of the controller.
    pub controller: controller::Parameters,
    /// Parameters of the plant.
    pub plant: PlantParameters,
}

/// Why a robot cannot walk here.
#[derive(Debug, thiserror::Error)]
pub enum WalkableRobotError {
    /// There is none of this name in the box.
    #[error("robot: {0}")]
    Unknown(String),
    /// It cannot be imported.
    #[error(transparent)]
    Import(#[from] ImportedRobotError),
    /// Its mechanism or its parameters are wrong.
    #[error(transparent)]
    Configuration(#[from] ConfigErrors),
    /// Its half-step is wrong.
    #[error(transparent)]
    HalfStep(#[from] TableFileError),
}

impl WalkableRobot {
    /// Names of the files that it is read from.
    pub const FILES: [&str; 4] = ["mechanism.toml", "nominal_half_step.csv", "controller.toml", "plant.toml"];

    /// The robot in the box with this name.
    ///
    /// # Errors
    /// There is none.
    pub fn in_the_box(name: &str) -> Result<Self, WalkableRobotError> {
        let robot = BuiltInRobot::named(name).map_err(WalkableRobotError::Unknown)?;
        Self::read(Path::new(""), &robot.files)
    }

    /// A robot that comes as a URDF, imported as by `halfstep import`; and what the import found, one text each.
    ///
    /// # Errors
    /// Everything that is wrong with URDF or map, or that no half-step suits the robot's joints.
    pub fn imported(urdf: NamedText, map: Option<NamedText>) -> Result<(Self, Vec<String>), WalkableRobotError> {
        let ImportedRobot { imported, files, .. } = ImportedRobot::new(urdf, map)?;
        let files = files.each_ref().map(|(name, text)| (*name, text.as_str()));
        Ok((Self::read(Path::new(""), &files)?, imported.lines))
    }

    /// Reads names and texts of the [files](Self::FILES) of a folder: paths in them are relative to it, and messages
    /// name it.
    ///
    /// # Errors
    /// Everything that is wrong in the first file that is.
    pub fn read(folder: &Path, files: &[(&str, &str)]) -> Result<Self, WalkableRobotError> {
        let [mechanism, nominal, controller, plant] = Self::FILES.map(|name| {
            let text = files.iter().find(|(file, _)| *file == name).map_or("", |(_, text)| *text);
            (text, folder.join(name))
        });
        Ok(Self {
            robot: Robot {
                mechanism: of_file(mechanism)?,
                nominal: Arc::new(NominalTable::from_csv(nominal.0, &nominal.1)?),
            },
            controller: of_file(controller)?,
            plant: of_file(plant)?,
        })
    }
}

fn of_file<C: Config>((text, file): (&str, PathBuf)) -> Result<C, ConfigErrors> {
    C::from_toml(text, &file.display().to_string())
}
