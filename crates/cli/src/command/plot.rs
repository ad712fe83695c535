//! `halfstep plot`: the pictures of a run, drawn from its recording.

use std::path::{Path, PathBuf};

use config::Config;
use model::Mechanism;
use node::configuration::MECHANISM;
use node::tell::tell;
use plots::picture;
use plots::run_log::{RunLog, write_csv};
use record::provenance_of;
use serde::Serialize;

use crate::error::CliError;
use crate::output::print;
use crate::output_folder::OutputFolder;
use crate::status::Status;

/// Draw the plots of a recorded run
#[derive(Clone, Debug, clap::Args)]
pub(super) struct PlotArgs {
    /// A recording, or the folder of a run
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Output folder [default: the folder of the recording]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Also write plant.csv and controller.csv
    #[arg(long)]
    csv: bool,
    /// Replace other pictures and tables in the folder
    #[arg(long)]
    force: bool,
}

/// Names of the written files.
#[derive(Clone, Debug, Serialize)]
struct PlotFiles {
    folder: PathBuf,
    files: Vec<String>,
}

impl PlotArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let own = if self.run.is_dir() { Some(self.run.as_path()) } else { self.run.parent() };
        let folder = self.out.clone().or_else(|| own.map(Path::to_owned)).unwrap_or_default();
        let origin = provenance_of(&self.run)?;
        let run = self.run.display();
        let text =
            origin.file(MECHANISM).ok_or_else(|| CliError::bad_input(format!("{run}: has no {MECHANISM} attached")))?;
        let mechanism = Mechanism::from_toml(text, &format!("{run}: {MECHANISM}")).map_err(CliError::bad_input)?;
        let out = OutputFolder::open(&folder, self.force)?;
        let log = RunLog::read(&self.run)?;
        if log.plant.is_empty() && log.controller.is_empty() {
            let notes = log.notes.join("; ");
            return Err(CliError::bad_input(format!("{run}: holds nothing to draw, no report and no state: {notes}")));
        }
        log.notes.iter().for_each(tell);

        let pictures = picture::of_run(&log, &mechanism);
        out.write(&pictures)?;
        let mut written: Vec<String> = pictures.iter().map(|(name, _)| (*name).to_owned()).collect();
        if self.csv {
            written.extend(out.write_with(|folder| Ok(write_csv(&self.run, folder)?.to_vec()))?);
        }
        print(json, &PlotFiles { folder, files: written })?;
        Ok(Status::Success)
    }
}

impl std::fmt::Display for PlotFiles {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        let folder = if self.folder.as_os_str().is_empty() { ".".into() } else { self.folder.display().to_string() };
        write!(out, "{} are in {folder}", self.files.join(", "))
    }
}
