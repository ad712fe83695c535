//! Reads the configuration files, and reports every error of all of them at once.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use config::{Config, ConfigErrors};
use controller::Controller;
use gait::{NominalTable, Robot, Start, TableFileError};
use model::{Mechanism, UrdfSource};
use plant::Disturbances;

use crate::cycle::Clock;
use crate::error::NodeError;
use crate::nominal_check::check_nominal;
use crate::realtime::RealtimeParameters;

/// Name of the mechanism's file.
pub const MECHANISM: &str = "mechanism.toml";
/// Name of the nominal half-step's file.
pub const NOMINAL: &str = "nominal_half_step.csv";
/// Name of the file with the controller's parameters.
pub const CONTROLLER: &str = "controller.toml";
/// Name of the file with the plant's parameters.
pub const PLANT: &str = "plant.toml";
/// Name of the file with the rate and the scheduling of both loops.
pub const REALTIME: &str = "realtime.toml";
/// The text that a folder without that file has: the machine does not depend on the robot.
const DEFAULT_REALTIME: &str = include_str!("../../../config/realtime.toml");
/// Name under which a recording holds the URDF that an external engine was given.
pub const URDF: &str = "robot.urdf";
/// Name under which a recording holds the plant's disturbances.
pub const DISTURBANCES: &str = "disturbances.toml";

/// The configuration files. Each is read once: what a recording holds is what was loaded, also if the file changes
/// meanwhile.
#[derive(Clone, Debug)]
pub struct ConfigFiles {
    /// Folder with mechanism.toml, nominal_half_step.csv, controller.toml, plant.toml and, unless the defaults will do,
    /// realtime.toml.
    pub folder: PathBuf,
    /// The mechanism's file, if not the folder's mechanism.toml.
    pub mechanism: Option<PathBuf>,
    /// The nominal half-step's file, if not the folder's nominal_half_step.csv.
    pub nominal: Option<PathBuf>,
    /// Texts of the files that were read.
    texts: RefCell<BTreeMap<PathBuf, String>>,
}

/// All errors found so far, one text each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Errors(pub Vec<String>);

/// Makes the controller of a process. It begins standing if `from_stand`, else in mid-walk; in lockstep the commands of
/// a stream do not expire.
///
/// # Errors
/// The robot cannot walk with these parameters.
pub fn controller(
    robot: &Robot,
    mut parameters: controller::Parameters,
    clock: Clock,
    from_stand: bool,
) -> Result<Controller, NodeError> {
    if clock == Clock::Lockstep {
        parameters = parameters.for_lockstep();
    }
    let begin = if from_stand { Controller::standing } else { Controller::new };
    begin(&robot.mechanism, Arc::clone(&robot.nominal), &parameters, Start::default()).map_err(NodeError::configuration)
}

impl Errors {
    /// Returns the value, or notes the error and returns `None`.
    pub fn note<T, E: Display>(&mut self, result: Result<T, E>) -> Option<T> {
        result.map_err(|error| self.0.push(error.to_string())).ok()
    }

    /// Returns the loaded values if no error was noted.
    ///
    /// # Errors
    /// All noted errors, one per line.
    pub fn finish<T>(self, loaded: Option<T>) -> Result<T, NodeError> {
        match loaded {
            Some(loaded) if self.0.is_empty() => Ok(loaded),
            _ => Err(NodeError::configuration(self.0.join("\n"))),
        }
    }
}

impl ConfigFiles {
    /// The files of a folder; mechanism and nominal half-step may be other files.
    pub fn new(folder: PathBuf, mechanism: Option<PathBuf>, nominal: Option<PathBuf>) -> Self {
        Self { folder, mechanism, nominal, texts: RefCell::default() }
    }

    /// The text of a file, read when it is asked for the first time.
    fn text(&self, path: &Path) -> std::io::Result<String> {
        if let Some(text) = self.texts.borrow().get(path) {
            return Ok(text.clone());
        }
        let text = match config::bounded_text(path) {
            Err(reason) if reason.kind() == ErrorKind::NotFound && path == self.folder.join(REALTIME) => {
                DEFAULT_REALTIME.to_owned()
            }
            read => read?,
        };
        self.texts.borrow_mut().insert(path.to_owned(), text.clone());
        Ok(text)
    }

    fn load<C: Config>(&self, path: &Path) -> Result<C, ConfigErrors> {
        let text = self.text(path).map_err(|reason| ConfigErrors::unreadable(path, &reason))?;
        C::from_toml(&text, &path.display().to_string())
    }

    fn load_nominal(&self, file: &Path) -> Result<NominalTable, TableFileError> {
        let text = self.text(file).map_err(|source| TableFileError::Io { file: file.to_owned(), source })?;
        NominalTable::from_csv(&text, file)
    }

    /// Path of the mechanism's file.
    pub fn mechanism_file(&self) -> PathBuf {
        self.mechanism.clone().unwrap_or_else(|| self.folder.join(MECHANISM))
    }

    /// Path of the plant's file.
    pub fn plant_file(&self) -> PathBuf {
        self.folder.join(PLANT)
    }

    /// Path of the nominal half-step's file.
    pub fn nominal_file(&self) -> PathBuf {
        self.nominal.clone().unwrap_or_else(|| self.folder.join(NOMINAL))
    }

    /// Path of the URDF from which the mechanism was imported: it lies beside the mechanism's file.
    pub fn urdf_file(&self, source: &UrdfSource) -> PathBuf {
        self.mechanism_file().with_file_name(&source.file)
    }

    /// The text of the URDF from which the mechanism was imported; `None` if its file is not there any more.
    ///
    /// # Errors
    /// The file is there, but cannot be read.
    pub fn urdf(&self, source: &UrdfSource) -> Result<Option<String>, NodeError> {
        let file = self.urdf_file(source);
        match self.text(&file) {
            Ok(text) => Ok(Some(text)),
            Err(reason) if reason.kind() == ErrorKind::NotFound => Ok(None),
            Err(reason) => Err(NodeError::file(&file)(reason)),
        }
    }

    /// Reads the mechanism alone.
    pub fn mechanism(&self, errors: &mut Errors) -> Option<Mechanism> {
        errors.note(self.load(&self.mechanism_file()))
    }

    /// Reads the mechanism and its nominal half-step, and checks that the one was made for the other.
    pub fn robot(&self, errors: &mut Errors) -> Option<Robot> {
        let (mechanism_file, nominal_file) = (self.mechanism_file(), self.nominal_file());
        let mechanism = self.mechanism(errors);
        let nominal = errors.note(self.load_nominal(&nominal_file));
        let (mechanism, nominal) = (mechanism?, nominal?);
        if nominal.mechanism == mechanism.body_fingerprint {
            errors.0.extend(check_nominal(&mechanism, &nominal, &nominal_file));
        } else {
            errors.0.push(format!(
                "{}: made for the mechanism {:#018x}, but {} is {:#018x}; make one for it with `{}`",
                nominal_file.display(),
                nominal.mechanism,
                mechanism_file.display(),
                mechanism.body_fingerprint,
                self.advice(&mechanism_file, &nominal_file),
            ));
        }
        Some(Robot { mechanism, nominal: Arc::new(nominal) })
    }

    /// How to make a nominal half-step for a mechanism: for another one than the folder's in a file of its own, which
    /// leaves the folder's as it is.
    fn advice(&self, mechanism: &Path, nominal: &Path) -> String {
        let synthesize = format!("halfstep synthesize --mechanism {}", mechanism.display());
        if self.mechanism.is_none() || self.nominal.is_some() {
            return format!("{synthesize} --out {} --force", nominal.display());
        }
        let stem = mechanism.file_stem().unwrap_or_default().to_string_lossy();
        let own = mechanism.with_file_name(format!("nominal_of_{stem}.csv"));
        format!("{synthesize} --out {0}` and use it with `--nominal {0}", own.display())
    }

    /// Reads the controller's parameters.
    pub fn controller(&self, errors: &mut Errors) -> Option<controller::Parameters> {
        errors.note(self.load(&self.folder.join(CONTROLLER)))
    }

    /// Reads what is set about the plant.
    pub fn plant(&self, errors: &mut Errors) -> Option<plant::PlantParameters> {
        errors.note(self.load(&self.plant_file()))
    }

    /// Reads the rate and the scheduling of both loops.
    pub fn realtime(&self, errors: &mut Errors) -> Option<RealtimeParameters> {
        errors.note(self.load(&self.folder.join(REALTIME)))
    }

    /// Reads the plant's disturbances; none without a file.
    pub fn disturbances(&self, file: Option<&Path>, errors: &mut Errors) -> Option<Disturbances> {
        file.map_or_else(|| Some(Disturbances::default()), |file| errors.note(self.load(file)))
    }

    /// The names and texts of a process's configuration files, for its recording: mechanism, nominal half-step, the
    /// folder's file `parameters`, the scheduling, and the disturbances if there are any.
    ///
    /// # Errors
    /// One of the files was not read before, and cannot be.
    pub fn texts(&self, parameters: &str, disturbances: Option<&Path>) -> Result<Vec<(String, String)>, NodeError> {
        let (mechanism, nominal) = (self.mechanism_file(), self.nominal_file());
        let [parameters, realtime] = [parameters, REALTIME].map(|name| (name, self.folder.join(name)));
        let files = [(MECHANISM, mechanism), (NOMINAL, nominal), parameters, realtime].into_iter();
        let files = files.chain(disturbances.map(|file| (DISTURBANCES, file.to_owned())));
        files.map(|(name, path)| Ok((name.to_owned(), self.text(&path).map_err(NodeError::file(&path))?))).collect()
    }
}
