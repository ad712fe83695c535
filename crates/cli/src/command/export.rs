//! `halfstep export`: the robot for other programs.

use std::path::PathBuf;

use clap::Subcommand;
use config::Config;
use interchange::mjcf::mjcf_text;
use interchange::urdf::urdf_text;
use node::configuration::Errors;
use node::realtime::RealtimeParameters;
use plant::PlantParameters;
use serde::Serialize;
use wire::python::python_messages;

use super::config_options::ConfigOptions;
use crate::error::CliError;
use crate::output::{print_json, print_line};
use crate::output_folder::OutputFolder;
use crate::status::Status;

/// Export the robot or the messages for other programs
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ExportArgs {
    #[command(subcommand)]
    format: Format,
}

#[derive(Clone, Debug, Subcommand)]
enum Format {
    /// The robot as URDF
    Urdf {
        #[command(flatten)]
        config: ConfigOptions,
        #[command(flatten)]
        to: ExportFile,
    },
    /// The robot as MJCF for MuJoCo, with floor and torque motors
    Mjcf {
        #[command(flatten)]
        config: ConfigOptions,
        /// Friction, slope, payload and integration step [default: plant.toml of the folder]
        #[arg(long, value_name = "FILE")]
        plant: Option<PathBuf>,
        /// Real-time parameters, which set the control rate [default: realtime.toml of the folder]
        #[arg(long, value_name = "FILE")]
        realtime: Option<PathBuf>,
        #[command(flatten)]
        to: ExportFile,
    },
    /// The shared-memory messages as a Python module
    Python {
        #[command(flatten)]
        to: ExportFile,
    },
}

/// Where the text goes.
#[derive(Clone, Debug, clap::Args)]
struct ExportFile {
    /// Output file [default: stdout]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace another file
    #[arg(long)]
    force: bool,
}

/// What was exported, as JSON: the text, or the file that holds it.
#[derive(Serialize)]
struct Exported {
    #[serde(skip_serializing_if = "Option::is_none")]
    text: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<PathBuf>,
}

impl ExportArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let (text, ExportFile { out, force }) = match self.format {
            Format::Urdf { mut config, to } => {
                config.resolve()?;
                let mut errors = Errors::default();
                let mechanism = config.files().mechanism(&mut errors);
                (urdf_text(&errors.finish(mechanism)?).map_err(CliError::new)?, to)
            }
            Format::Mjcf { mut config, plant, realtime, to } => {
                config.resolve()?;
                let (mut errors, files) = (Errors::default(), config.files());
                let mechanism = files.mechanism(&mut errors);
                let parameters = match plant {
                    Some(file) => errors.note(PlantParameters::load(&file)),
                    None => files.plant(&mut errors),
                };
                let realtime = match realtime {
                    Some(file) => errors.note(RealtimeParameters::load(&file)),
                    None => files.realtime(&mut errors),
                };
                let ((mechanism, parameters), realtime) = errors.finish(mechanism.zip(parameters).zip(realtime))?;
                (mjcf_text(&mechanism, &parameters, realtime.rate.period_s()), to)
            }
            Format::Python { to } => (python_messages(), to),
        };
        if let Some(file) = &out {
            let (folder, name) = OutputFolder::of_file(file, force)?;
            folder.write(&[(name, text.clone())])?;
        }
        match (out, json) {
            (None, false) => print_line(text.trim_end())?,
            (None, true) => print_json(&Exported { text: Some(text), file: None })?,
            (Some(_), false) => {}
            (file, true) => print_json(&Exported { text: None, file })?,
        }
        Ok(Status::Success)
    }
}
