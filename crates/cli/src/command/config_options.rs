//! Options for the configuration files.

use std::ffi::OsString;
use std::path::PathBuf;

use node::configuration::{ConfigFiles, REALTIME};

use super::options::path_option;

/// Where the configuration lies.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ConfigOptions {
    /// Folder with mechanism.toml, nominal_half_step.csv, controller.toml, plant.toml and realtime.toml
    #[arg(long, value_name = "DIR", default_value = "config")]
    config: PathBuf,
    /// Robot description [default: mechanism.toml of the folder]
    #[arg(long, value_name = "FILE")]
    mechanism: Option<PathBuf>,
    /// Nominal half-step [default: nominal_half_step.csv of the folder]
    #[arg(long, value_name = "FILE")]
    nominal: Option<PathBuf>,
}

impl ConfigOptions {
    /// Paths of the configuration files.
    pub(super) fn files(&self) -> ConfigFiles {
        let Self { config, mechanism, nominal } = self.clone();
        ConfigFiles::new(config, mechanism, nominal)
    }

    /// Path of the real-time parameters.
    pub(super) fn realtime_file(&self) -> PathBuf {
        self.config.join(REALTIME)
    }

    /// The same options as arguments for another process.
    pub(super) fn arguments(&self) -> Vec<OsString> {
        let files = [("--mechanism", &self.mechanism), ("--nominal", &self.nominal)];
        let files = files.into_iter().filter_map(|(option, file)| Some((option, file.as_ref()?)));
        [("--config", &self.config)].into_iter().chain(files).map(|(option, path)| path_option(option, path)).collect()
    }
}
