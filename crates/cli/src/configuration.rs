//! The configuration files, read with every error of all of them at once.

use std::ffi::OsString;
use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use controller::Controller;
use gait::{NominalTable, Start};
use model::{Joint, Mechanism, Mirror};
use plant::Disturbances;

use crate::failure::Failure;
use crate::realtime::RealtimeParameters;
use crate::turns::Clock;

/// The robot's file.
pub const MECHANISM: &str = "mechanism.toml";
/// The half-step's file.
pub const NOMINAL: &str = "nominal_half_step.csv";
/// The controller's parameters.
pub const CONTROLLER: &str = "controller.toml";
/// The plant's parameters.
pub const PLANT: &str = "plant.toml";
/// The parameters of both loops' time.
pub const REALTIME: &str = "realtime.toml";
/// What happens to the plant, as a recording calls it.
pub const DISTURBANCES: &str = "disturbances.toml";

/// Where the configuration lies.
#[derive(Clone, Debug, clap::Args)]
pub struct ConfigOptions {
    /// Folder with mechanism.toml, nominal_half_step.csv, controller.toml, plant.toml and realtime.toml
    #[arg(long, value_name = "DIR", default_value = "config")]
    pub config: PathBuf,
    /// The robot, if not the folder's mechanism.toml
    #[arg(long, value_name = "FILE")]
    pub mechanism: Option<PathBuf>,
    /// The half-step, if not the folder's nominal_half_step.csv
    #[arg(long, value_name = "FILE")]
    pub nominal: Option<PathBuf>,
}

/// A robot and how it walks; the one was made for the other.
#[derive(Clone, Debug)]
pub struct Robot {
    /// The robot.
    pub mechanism: Mechanism,
    /// Its half-step.
    pub nominal: Arc<NominalTable>,
}

/// Everything wrong that was found so far.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Errors(pub Vec<String>);

impl Robot {
    /// The controller of a process that goes by `clock` and begins `from_stand` or in stride.
    ///
    /// # Errors
    /// Robot and parameters do not go together.
    pub fn controller(
        &self,
        mut parameters: controller::Parameters,
        clock: Clock,
        from_stand: bool,
    ) -> Result<Controller, Failure> {
        if clock == Clock::Lockstep {
            // Operators live by the clock on the wall, and half a second in lockstep is over in a few milliseconds.
            parameters.sources.age_limit = None;
        }
        let begin = if from_stand { Controller::standing } else { Controller::new };
        begin(&self.mechanism, Arc::clone(&self.nominal), &parameters, Start::default()).map_err(Failure::bad_input)
    }
}

/// A file's text.
pub fn read(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|error| Failure::new(format!("{}: {error}", path.display())))
}

impl Errors {
    /// The value, or `None` and a note of what is wrong.
    pub fn note<T, E: Display>(&mut self, result: Result<T, E>) -> Option<T> {
        result.map_err(|error| self.0.push(error.to_string())).ok()
    }

    /// The loaded values, if nothing at all was wrong.
    ///
    /// # Errors
    /// Everything that was noted.
    pub fn finish<T>(self, loaded: Option<T>) -> Result<T, Failure> {
        match loaded {
            Some(loaded) if self.0.is_empty() => Ok(loaded),
            _ => Err(Failure::bad_input(self.0.join("\n"))),
        }
    }
}

impl ConfigOptions {
    /// The mechanism's file.
    pub fn mechanism_file(&self) -> PathBuf {
        self.mechanism.clone().unwrap_or_else(|| self.config.join(MECHANISM))
    }

    /// The nominal half-step's file.
    pub fn nominal_file(&self) -> PathBuf {
        self.nominal.clone().unwrap_or_else(|| self.config.join(NOMINAL))
    }

    /// Reads mechanism and nominal, and checks that they fit.
    pub fn robot(&self, errors: &mut Errors) -> Option<Robot> {
        let (mechanism_file, nominal_file) = (self.mechanism_file(), self.nominal_file());
        let mechanism = errors.note(Mechanism::load(&mechanism_file));
        let nominal = errors.note(NominalTable::read_csv(&nominal_file));
        let (mechanism, nominal) = (mechanism?, nominal?);
        if nominal.mechanism == mechanism.fingerprint {
            check_nominal(&mechanism, &nominal, &nominal_file, errors);
        } else {
            errors.0.push(format!(
                "{nominal_file}: made for the mechanism {:#018x}, but {mechanism_file} is {:#018x}; make one for it with \
                 `halfstep synthesize --mechanism {mechanism_file} --out {nominal_file}`",
                nominal.mechanism,
                mechanism.fingerprint,
                nominal_file = nominal_file.display(),
                mechanism_file = mechanism_file.display(),
            ));
        }
        Some(Robot { mechanism, nominal: Arc::new(nominal) })
    }

    /// Reads what is set about the controller.
    pub fn controller(&self, errors: &mut Errors) -> Option<controller::Parameters> {
        errors.note(controller::Parameters::load(self.config.join(CONTROLLER)))
    }

    /// Reads what is set about the plant.
    pub fn plant(&self, errors: &mut Errors) -> Option<plant::Parameters> {
        errors.note(plant::Parameters::load(self.config.join(PLANT)))
    }

    /// Reads what is set about the loops' time.
    pub fn realtime(&self, errors: &mut Errors) -> Option<RealtimeParameters> {
        errors.note(RealtimeParameters::load(self.config.join(REALTIME)))
    }

    /// Reads what happens to the plant, if anything.
    pub fn disturbances(file: Option<&Path>, errors: &mut Errors) -> Option<Disturbances> {
        file.map_or_else(|| Some(Disturbances::default()), |file| errors.note(Disturbances::load(file)))
    }

    /// The exact texts of what a process began with, for its recording: mechanism, half-step, the folder's file `parameters`,
    /// and what is set about the loops' time.
    ///
    /// # Errors
    /// One of the files cannot be read any more.
    pub fn texts(&self, parameters: &str) -> Result<Vec<(String, String)>, Failure> {
        let (mechanism, nominal) = (self.mechanism_file(), self.nominal_file());
        let [parameters, realtime] = [parameters, REALTIME].map(|name| (name, self.config.join(name)));
        let files = [(MECHANISM, mechanism), (NOMINAL, nominal), parameters, realtime];
        files.into_iter().map(|(name, path)| Ok((name.to_owned(), read(&path)?))).collect()
    }

    /// The same options, for another process.
    pub fn arguments(&self) -> Vec<OsString> {
        let files = [("--mechanism", &self.mechanism), ("--nominal", &self.nominal)];
        let files = files.into_iter().filter_map(|(option, file)| Some((option, file.as_ref()?)));
        [("--config", &self.config)]
            .into_iter()
            .chain(files)
            .flat_map(|(option, path)| [option.into(), path.into()])
            .collect()
    }
}

/// Notes where the half-step does not close, and where it asks for what the joints cannot do, once per joint.
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
