//! Reads the configuration files, and reports every error of all of them at once.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use config::Config;
use controller::Controller;
use gait::{NominalTable, Robot, Start};
use model::{Joint, Mechanism, Mirror};
use plant::Disturbances;

use crate::cycle::Clock;
use crate::error::NodeError;
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
/// Name under which a recording holds the plant's disturbances.
pub const DISTURBANCES: &str = "disturbances.toml";

/// Paths of the configuration files.
#[derive(Clone, Debug)]
pub struct ConfigFiles {
    /// Folder with mechanism.toml, nominal_half_step.csv, controller.toml, plant.toml and realtime.toml.
    pub folder: PathBuf,
    /// The mechanism's file, if not the folder's mechanism.toml.
    pub mechanism: Option<PathBuf>,
    /// The nominal half-step's file, if not the folder's nominal_half_step.csv.
    pub nominal: Option<PathBuf>,
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
        // Operators live by wall-clock time, and half a second of lockstep passes in a few milliseconds.
        parameters.arbiter.timeout = None;
    }
    let begin = if from_stand { Controller::standing } else { Controller::new };
    begin(&robot.mechanism, Arc::clone(&robot.nominal), &parameters, Start::default()).map_err(NodeError::configuration)
}

/// Reads a file's text.
///
/// # Errors
/// The file cannot be read.
pub fn read(path: &Path) -> Result<String, NodeError> {
    fs::read_to_string(path).map_err(NodeError::file(path))
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
    /// Path of the mechanism's file.
    pub fn mechanism_file(&self) -> PathBuf {
        self.mechanism.clone().unwrap_or_else(|| self.folder.join(MECHANISM))
    }

    /// Path of the nominal half-step's file.
    pub fn nominal_file(&self) -> PathBuf {
        self.nominal.clone().unwrap_or_else(|| self.folder.join(NOMINAL))
    }

    /// Reads the mechanism and its nominal half-step, and checks that the one was made for the other.
    pub fn robot(&self, errors: &mut Errors) -> Option<Robot> {
        let (mechanism_file, nominal_file) = (self.mechanism_file(), self.nominal_file());
        let mechanism = errors.note(Mechanism::load(&mechanism_file));
        let nominal = errors.note(NominalTable::read_csv(&nominal_file));
        let (mechanism, nominal) = (mechanism?, nominal?);
        if nominal.mechanism == mechanism.fingerprint {
            check_nominal(&mechanism, &nominal, &nominal_file, errors);
        } else {
            errors.0.push(format!(
                "{nominal_file}: made for the mechanism {:#018x}, but {mechanism_file} is {:#018x}; make one for it \
                 with \
                 `halfstep synthesize --mechanism {mechanism_file} --out {nominal_file}`",
                nominal.mechanism,
                mechanism.fingerprint,
                nominal_file = nominal_file.display(),
                mechanism_file = mechanism_file.display(),
            ));
        }
        Some(Robot { mechanism, nominal: Arc::new(nominal) })
    }

    /// Reads the controller's parameters.
    pub fn controller(&self, errors: &mut Errors) -> Option<controller::Parameters> {
        errors.note(controller::Parameters::load(self.folder.join(CONTROLLER)))
    }

    /// Reads what is set about the plant.
    pub fn plant(&self, errors: &mut Errors) -> Option<plant::PlantParameters> {
        errors.note(plant::PlantParameters::load(self.folder.join(PLANT)))
    }

    /// Reads the rate and the scheduling of both loops.
    pub fn realtime(&self, errors: &mut Errors) -> Option<RealtimeParameters> {
        errors.note(RealtimeParameters::load(self.folder.join(REALTIME)))
    }

    /// Reads the plant's disturbances; none without a file.
    pub fn disturbances(file: Option<&Path>, errors: &mut Errors) -> Option<Disturbances> {
        file.map_or_else(|| Some(Disturbances::default()), |file| errors.note(Disturbances::load(file)))
    }

    /// The names and texts of a process's configuration files, for its recording: mechanism, nominal half-step, the
    /// folder's file `parameters`, and the scheduling.
    ///
    /// # Errors
    /// One of the files can no longer be read.
    pub fn texts(&self, parameters: &str) -> Result<Vec<(String, String)>, NodeError> {
        let (mechanism, nominal) = (self.mechanism_file(), self.nominal_file());
        let [parameters, realtime] = [parameters, REALTIME].map(|name| (name, self.folder.join(name)));
        let files = [(MECHANISM, mechanism), (NOMINAL, nominal), parameters, realtime];
        files.into_iter().map(|(name, path)| Ok((name.to_owned(), read(&path)?))).collect()
    }
}

/// Notes whether the end of the half-step differs from the mirror image of its start, and for each joint where it first
/// exceeds the joint's limits.
fn check_nominal(mechanism: &Mechanism, nominal: &NominalTable, file: &Path, errors: &mut Errors) {
    let file = file.display();
    if let Some(mirror) = Mirror::new(mechanism)
        && let Err(error) = nominal.check(&mirror)
    {
        errors.0.push(format!("{file}: {error}"));
    }
    for joint in Joint::ALL {
        let Some(limits) = mechanism.links[joint].limits else { continue };
        let (number, name) = (joint.number(), joint.name());
        let (min, max) = (limits.angle_min, limits.angle_max);
        let angles = nominal.rows.iter().map(|row| row.motion.angles[joint]).enumerate();
        if let Some((row, angle)) = angles.into_iter().find(|(_, angle)| !(min..=max).contains(angle)) {
            let [angle, min, max] = [angle, min, max].map(f64::to_degrees);
            errors.0.push(format!(
                "{file}: interval {row}: joint {number} ({name}) is at {angle:.2}°; its range is {min:.2}° to {max:.2}°"
            ));
        }
        let rates = nominal.rows.iter().map(|row| row.motion.rates[joint]).enumerate();
        if let Some((row, rate)) = rates.into_iter().find(|(_, rate)| rate.abs() > limits.rate_max) {
            let [rate, max] = [rate, limits.rate_max].map(f64::to_degrees);
            errors.0.push(format!(
                "{file}: interval {row}: joint {number} ({name}) moves at {rate:.1} °/s; its limit is {max:.1} °/s"
            ));
        }
    }
}
