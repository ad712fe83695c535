//! A complete configuration folder for a robot that comes as a URDF.

use config::{Config, ConfigErrors};
use gait::TableFileError;
use interchange::import::{ImportError, Imported, NamedText, import};
use interchange::scaled_parameters::{controller_text, plant_text};
use model::Mechanism;
use synthesis::{FittedHalfStep, SynthesisError, fit_half_step};

/// Parameters of the paper's robot, from which those of others are scaled.
const CONTROLLER: &str = include_str!("../../../config/controller.toml");
const PLANT: &str = include_str!("../../../config/plant.toml");
const REALTIME: &str = include_str!("../../../config/realtime.toml");
/// The URDF's name in the folder.
pub const URDF: &str = "robot.urdf";

/// Why a robot cannot walk by its URDF.
#[derive(Debug, thiserror::Error)]
pub enum ImportedRobotError {
    /// URDF or map are wrong, or what they describe cannot walk.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// What was imported is no mechanism.
    #[error(transparent)]
    Mechanism(#[from] ConfigErrors),
    /// No half-step suits its joints.
    #[error(transparent)]
    HalfStep(#[from] SynthesisError),
    /// Its half-step cannot be written down.
    #[error(transparent)]
    Table(#[from] TableFileError),
}

/// A robot that was imported, with everything that it needs to walk.
#[derive(Clone, Debug)]
pub struct ImportedRobot {
    /// What the importer found.
    pub imported: Imported,
    /// Its nominal half-step.
    pub half_step: FittedHalfStep,
    /// Names and texts of the folder's files, without the URDF.
    pub files: [(&'static str, String); 5],
}

impl ImportedRobot {
    /// Imports a robot, and finds a half-step and parameters for it.
    ///
    /// # Errors
    /// Everything that is wrong with URDF or map, or that no half-step suits the robot's joints.
    pub fn new(urdf: NamedText, map: Option<NamedText>) -> Result<Self, ImportedRobotError> {
        let imported = import(urdf, map)?;
        let name = format!("the mechanism read from {}", urdf.file);
        let mechanism = Mechanism::from_toml(&imported.text, &name)?;
        let half_step = fit_half_step(&mechanism)?;
        let nominal = half_step.synthesis.table.to_csv()?;
        let files = [
            ("mechanism.toml", with_copied_urdf(&imported.text)),
            ("nominal_half_step.csv", nominal),
            ("controller.toml", controller_text(CONTROLLER, &mechanism)),
            ("plant.toml", plant_text(PLANT, &mechanism)),
            ("realtime.toml", REALTIME.to_owned()),
        ];
        Ok(Self { imported, half_step, files })
    }
}

/// The mechanism's text with the URDF's name in the folder: wherever the URDF was, its copy is beside the mechanism.
fn with_copied_urdf(text: &str) -> String {
    const KEY: &str = "[source]\nurdf = ";
    match text.split_once(KEY).and_then(|(before, rest)| Some((before, rest.split_once('\n')?.1))) {
        Some((before, after)) => format!("{before}{KEY}\"{URDF}\"\n{after}"),
        None => text.to_owned(),
    }
}
