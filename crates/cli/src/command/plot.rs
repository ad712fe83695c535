//! `halfstep plot`: the pictures of a run, drawn from its recording.

use std::path::{Path, PathBuf};

use ::record::origin_of;
use model::Mechanism;
use serde::Serialize;

use super::{print, write_pictures};
use crate::configuration::MECHANISM;
use crate::failure::{Failure, Outcome};
use crate::picture;
use crate::run_log::{RunLog, write_rows};

/// Draw the pictures of a recorded run
#[derive(Clone, Debug, clap::Args)]
pub struct Plot {
    /// A recording, or the folder of a run
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Folder for the pictures; the recording's own if absent
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write plant.csv and controller.csv, too
    #[arg(long)]
    csv: bool,
}

/// What was written.
#[derive(Clone, Debug, Serialize)]
struct Written {
    folder: PathBuf,
    files: Vec<String>,
}

impl Plot {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let origin = origin_of(&self.run)?;
        let run = self.run.display();
        let text =
            origin.file(MECHANISM).ok_or_else(|| Failure::bad_input(format!("{run}: has no {MECHANISM} attached")))?;
        let mechanism = Mechanism::from_toml(text, &format!("{run}: {MECHANISM}")).map_err(Failure::bad_input)?;
        let log = RunLog::read(&self.run)?;

        let own = if self.run.is_dir() { Some(self.run.as_path()) } else { self.run.parent() };
        let folder = self.out.clone().or_else(|| own.map(Path::to_owned)).unwrap_or_default();
        let pictures = picture::of_run(&log, &mechanism);
        write_pictures(&folder, &pictures)?;
        let mut written: Vec<String> = pictures.iter().map(|(name, _)| (*name).to_owned()).collect();
        if self.csv {
            let rows = [write_rows(&folder, &log.plant)?, write_rows(&folder, &log.controller)?];
            written.extend(rows.iter().filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned())));
        }
        print(json, &Written { folder, files: written })?;
        Ok(Outcome::Fine)
    }
}

impl std::fmt::Display for Written {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        let folder = if self.folder.as_os_str().is_empty() { ".".into() } else { self.folder.display().to_string() };
        write!(out, "{} are in {folder}", self.files.join(", "))
    }
}
