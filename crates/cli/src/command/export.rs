//! `halfstep export`: the robot for other programs.

use std::path::PathBuf;

use clap::Subcommand;
use config::Config;
use interchange::mjcf::mjcf_text;
use interchange::urdf::urdf_text;
use model::Mechanism;
use node::configuration::Errors;
use node::realtime::RealtimeParameters;
use serde::Serialize;
use wire::python::python_messages;

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
        /// Robot description
        #[arg(long, value_name = "FILE", default_value = "config/mechanism.toml")]
        mechanism: PathBuf,
        #[command(flatten)]
        to: ExportFile,
    },
    /// The robot as MJCF for MuJoCo, with floor and torque motors
    Mjcf {
        /// Robot description
        #[arg(long, value_name = "FILE", default_value = "config/mechanism.toml")]
        mechanism: PathBuf,
        /// Friction, slope, payload and integration step
        #[arg(long, value_name = "FILE", default_value = "config/plant.toml")]
        plant: PathBuf,
        /// Real-time parameters; they set the control rate
        #[arg(long, value_name = "FILE", default_value = "config/realtime.toml")]
        realtime: PathBuf,
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
            Format::Urdf { mechanism, to } => {
                let mechanism = Mechanism::load(&mechanism).map_err(CliError::bad_input)?;
                (urdf_text(&mechanism).map_err(CliError::new)?, to)
            }
            Format::Mjcf { mechanism, plant, realtime, to } => {
                let mut errors = Errors::default();
                let mechanism = errors.note(Mechanism::load(&mechanism));
                let parameters = errors.note(plant::PlantParameters::load(&plant));
                let realtime = errors.note(RealtimeParameters::load(&realtime));
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
