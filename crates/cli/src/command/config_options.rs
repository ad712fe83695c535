//! Options for the configuration files.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use node::configuration::{ConfigFiles, REALTIME};
use robots::BuiltInRobot;

use super::options::path_option;
use crate::error::CliError;
use crate::robot_folder::folder_of;

/// Where the configuration lies.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ConfigOptions {
    /// Folder with mechanism.toml, nominal_half_step.csv, controller.toml, plant.toml and, if need be, realtime.toml
    /// [default: config where there is such a folder, else the paper's robot]
    #[arg(long, value_name = "DIR", conflicts_with = "robot")]
    config: Option<PathBuf>,
    /// A robot in the box instead of a folder: see `halfstep robots`
    #[arg(long, value_name = "NAME", value_parser = BuiltInRobot::named)]
    robot: Option<BuiltInRobot>,
    /// Robot description [default: mechanism.toml of the folder]
    #[arg(long, value_name = "FILE")]
    mechanism: Option<PathBuf>,
    /// Nominal half-step [default: nominal_half_step.csv of the folder]
    #[arg(long, value_name = "FILE")]
    nominal: Option<PathBuf>,
}

/// The folder that is used when it is there.
const DEFAULT: &str = "config";

impl ConfigOptions {
    /// Chooses the folder: that of a robot in the box is in the user's cache.
    ///
    /// # Errors
    /// The cache cannot be written.
    pub(super) fn resolve(&mut self) -> Result<(), CliError> {
        if self.config.is_none() {
            let in_box = match self.robot.take() {
                None if Path::new(DEFAULT).join("mechanism.toml").exists() => None,
                None => Some(BuiltInRobot::of_the_paper()),
                robot => robot,
            };
            self.config = Some(in_box.map_or_else(|| Ok(PathBuf::from(DEFAULT)), |robot| folder_of(&robot))?);
        }
        Ok(())
    }

    /// The folder. Of options that are not [`resolve`](Self::resolve)d it is the default.
    fn folder(&self) -> PathBuf {
        self.config.clone().unwrap_or_else(|| PathBuf::from(DEFAULT))
    }

    /// Paths of the configuration files.
    pub(super) fn files(&self) -> ConfigFiles {
        let Self { mechanism, nominal, .. } = self.clone();
        ConfigFiles::new(self.folder(), mechanism, nominal)
    }

    /// Path of the real-time parameters.
    pub(super) fn realtime_file(&self) -> PathBuf {
        self.folder().join(REALTIME)
    }

    /// The same options as arguments for another process.
    pub(super) fn arguments(&self) -> Vec<OsString> {
        let folder = self.folder();
        let files = [("--mechanism", &self.mechanism), ("--nominal", &self.nominal)];
        let files = files.into_iter().filter_map(|(option, file)| Some((option, file.as_ref()?)));
        [("--config", &folder)].into_iter().chain(files).map(|(option, path)| path_option(option, path)).collect()
    }
}
