//! `halfstep plot`: the pictures of a run, or of two over each other, drawn from recordings.

use std::path::{Path, PathBuf};

use node::tell::tell;
use plots::comparison::{ComparedLine, compared_lines, compared_pictures, comparison_page};
use plots::picture::{self, ComparedRun};
use plots::run_log::{TimeWindow, write_csv};
use plots::run_page::run_page;
use plots::run_summary::RunSummary;
use serde::Serialize;

use super::options::run_time;
use crate::error::CliError;
use crate::output::print;
use crate::output_folder::OutputFolder;
use crate::plotted_run::PlottedRun;
use crate::status::Status;

/// Draw the plots of a recorded run, or of two runs over each other
#[derive(Clone, Debug, clap::Args)]
pub(super) struct PlotArgs {
    /// A recording, or the folder of a run
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Another run to draw over it: pictures and a table of both
    #[arg(long, value_name = "RUN", conflicts_with = "csv")]
    against: Option<PathBuf>,
    /// Draw the run from this time on, e.g. 3.5s [default: its beginning]
    #[arg(long, value_name = "TIME", value_parser = run_time)]
    from: Option<f64>,
    /// Draw the run up to this time [default: its end]
    #[arg(long, value_name = "TIME", value_parser = run_time)]
    to: Option<f64>,
    /// Output folder [default: the folder of the recording]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Also write plant.csv, controller.csv and drives.csv
    #[arg(long)]
    csv: bool,
    /// Replace other pictures and tables in the folder
    #[arg(long)]
    force: bool,
}

/// What was drawn of a run.
#[derive(Clone, Debug, Serialize)]
struct PlotFiles {
    folder: PathBuf,
    files: Vec<String>,
    /// Pictures that are missing and why.
    missing: Vec<String>,
    summary: RunSummary,
}

/// What was drawn of two runs.
#[derive(Clone, Debug, Serialize)]
struct ComparedFiles {
    folder: PathBuf,
    files: Vec<String>,
    first: RunSummary,
    second: RunSummary,
    #[serde(skip)]
    names: [String; 2],
}

impl PlotArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let run = PlottedRun::read(&self.run, self.window()?)?;
        match &self.against {
            None => self.plot(&run, json),
            Some(other) => self.compare(&run, &PlottedRun::read(other, self.window()?)?, json),
        }
    }

    /// The part of the run that is asked for; `None` for all of it.
    fn window(&self) -> Result<Option<TimeWindow>, CliError> {
        let window =
            TimeWindow { from: self.from.unwrap_or(TimeWindow::ALL.from), to: self.to.unwrap_or(TimeWindow::ALL.to) };
        if window.to <= window.from {
            let TimeWindow { from, to } = window;
            return Err(CliError::bad_input(format!("--from {from} --to {to}: must end after it begins")));
        }
        Ok((window != TimeWindow::ALL).then_some(window))
    }

    /// Where to draw to.
    fn folder(&self) -> PathBuf {
        let own = if self.run.is_dir() { Some(self.run.as_path()) } else { self.run.parent() };
        self.out.clone().or_else(|| own.map(Path::to_owned)).unwrap_or_default()
    }

    fn plot(&self, run: &PlottedRun, json: bool) -> Result<Status, CliError> {
        let PlottedRun { name, provenance, mechanism, floor, log, summary } = run;
        log.notes.iter().for_each(tell);
        let out = OutputFolder::open(&self.folder(), self.force)?;
        let pictures = picture::of_run(log, mechanism, floor);
        let page = run_page(name, summary, &pictures, &log.notes, provenance);
        let files = pictures.drawn.into_iter().map(|picture| (picture.file, picture.svg));
        let files: Vec<(&str, String)> = files.chain([("index.html", page)]).collect();
        out.write(&files)?;
        let mut files: Vec<String> = files.into_iter().map(|(name, _)| name.to_owned()).collect();
        if self.csv {
            files.extend(out.write_with(|folder| Ok(write_csv(&self.run, folder, Some(mechanism))?.to_vec()))?);
        }
        let folder = self.folder();
        print(json, &PlotFiles { folder, files, missing: pictures.missing, summary: summary.clone() })?;
        Ok(Status::Success)
    }

    fn compare(&self, run: &PlottedRun, other: &PlottedRun, json: bool) -> Result<Status, CliError> {
        let runs = [run, other];
        let names = runs.map(|run| run.name.clone());
        let notes = runs.iter().flat_map(|run| run.log.notes.iter().map(|note| format!("{}: {note}", run.name)));
        let notes: Vec<String> = notes.collect();
        notes.iter().for_each(tell);
        let compared = runs.map(|run| ComparedRun { name: &run.name, log: &run.log, mechanism: &run.mechanism });
        let pictures = compared_pictures(&compared);
        let [first, second] = runs.map(|run| run.summary.clone());
        let lines = compared_lines([&first, &second]);
        let page = comparison_page(names.each_ref().map(String::as_str), &lines, &pictures, &notes);
        let files = pictures.into_iter().map(|picture| (picture.file, picture.svg));
        let files: Vec<(&str, String)> = files.chain([("comparison.html", page)]).collect();
        let folder = self.folder();
        OutputFolder::open(&folder, self.force)?.write(&files)?;
        let files = files.into_iter().map(|(name, _)| name.to_owned()).collect();
        print(json, &ComparedFiles { folder, files, first, second, names })?;
        Ok(Status::Success)
    }
}

impl std::fmt::Display for PlotFiles {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        for (name, value) in self.summary.lines() {
            writeln!(out, "{name:<36}{value}")?;
        }
        self.missing.iter().try_for_each(|missing| writeln!(out, "not drawn: {missing}"))?;
        files_are_in(out, &self.files, &self.folder)
    }
}

impl std::fmt::Display for ComparedFiles {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        let lines = compared_lines([&self.first, &self.second]);
        let [one, other] = &self.names;
        let head: ComparedLine = ("", [one.clone(), other.clone()]);
        let width = |text: &String| text.chars().count();
        let column = lines.iter().chain([&head]).map(|(_, [one, _])| width(one)).max().unwrap_or(0) + 2;
        for (name, [one, other]) in [&head].into_iter().chain(&lines) {
            writeln!(out, "{name:<36}{one:<column$}{other}")?;
        }
        files_are_in(out, &self.files, &self.folder)
    }
}

fn files_are_in(out: &mut std::fmt::Formatter, files: &[String], folder: &Path) -> std::fmt::Result {
    let folder = if folder.as_os_str().is_empty() { ".".into() } else { folder.display().to_string() };
    write!(out, "{} are in {folder}", files.join(", "))
}
