//! `halfstep paper --search`: one plausible body and one reading for as many verdicts as possible.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;
use std::thread::available_parallelism;

use ::paper::{FileText, FoundFiles, Freedom, OPEN_NUMBERS, Reading, Scenario, SearchBase, SearchOptions, search};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use gait::Robot;
use indicatif::{ProgressBar, ProgressStyle};
use node::configuration::ConfigFiles;

use super::paper_files::{PaperFiles, SCENARIOS};
use crate::error::CliError;
use crate::output::{print_json, print_line, quoted};
use crate::output_folder::OutputFolder;
use crate::status::Status;

/// Files that the found configuration has from the folder, where there are such.
const COPIED: [&str; 3] = ["controller.toml", "plant.toml", "realtime.toml"];

/// How to search.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SearchArgs {
    /// Search for one plausible body and one reading that make as many stated verdicts true as possible, and say what
    /// the others would need; with --out, write them into a new folder for --config
    #[arg(long, conflicts_with_all = ["figure", "turn_ramp", "extension_ramp"])]
    pub search: bool,
    /// Number of candidates that the search draws
    #[arg(long, value_name = "N", default_value = "2000", requires = "search")]
    candidates: NonZeroUsize,
    /// Seed of the search: the same one finds the same
    #[arg(long, value_name = "N", default_value_t = 1, requires = "search")]
    seed: u64,
    /// Let the search change only these: axes, ramps, and the named numbers [default: all but leg_mass_share,
    /// arm_mass_share and hip_height_share]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = varied(), requires = "search")]
    vary: Vec<String>,
}

impl SearchArgs {
    /// Searches from a folder's robot and reading.
    pub(super) fn run(
        &self,
        files: &ConfigFiles,
        texts: PaperFiles,
        (robot, reading): (&Robot, Reading),
        scenarios: Vec<Scenario>,
        out: Option<&Path>,
        json: bool,
    ) -> Result<Status, CliError> {
        out.map_or(Ok(()), check_is_new)?;
        // Whether it can be written is known before the search.
        out.map(|out| OutputFolder::open(out, false)).transpose()?;
        let PaperFiles { reading: FileText { text: reading_text, .. }, scenarios: scenario_texts, other_axes } = texts;
        let mechanisms = [text_of(&files.mechanism_file())?].into_iter().chain(other_axes).collect();
        let base = SearchBase::new(mechanisms, robot, reading, reading_text, scenarios).map_err(CliError::bad_input)?;

        let options = SearchOptions {
            freedom: self.freedom(),
            seed: self.seed,
            candidates: self.candidates.get(),
            threads: available_parallelism().map_or(1, NonZeroUsize::get),
        };
        let bar = ProgressBar::new(options.candidates as u64);
        let style = ProgressStyle::with_template("{bar:20} {pos} of {len} candidates tried");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let found = search(&base, &options, &mut |tried| bar.set_position(tried.min(options.candidates) as u64));
        bar.finish_and_clear();
        let (candidate, report) = found.map_err(CliError::bad_input)?;

        if let Some(out) = out {
            let found = base.files(&candidate, &scenario_texts).map_err(CliError::bad_input)?;
            write(&found, &files.folder, out)?;
        }
        if json {
            print_json(&report)?;
        } else {
            print_line(report)?;
            if let Some(out) = out {
                print_line(format_args!("written: halfstep paper --config {}", quoted(&out.display().to_string())))?;
            }
        }
        Ok(Status::Success)
    }

    fn freedom(&self) -> Freedom {
        let may = |name: &str, unless_told: bool| match self.vary.as_slice() {
            [] => unless_told,
            vary => vary.iter().any(|varied| varied == name),
        };
        Freedom {
            numbers: OPEN_NUMBERS.map(|number| may(number.name, number.is_searched)),
            ramps: may("ramps", true),
            axes: may("axes", true),
        }
    }
}

/// The name of what a search may change.
fn varied() -> impl TypedValueParser<Value = String> {
    PossibleValuesParser::new(["axes", "ramps"].into_iter().chain(OPEN_NUMBERS.map(|number| number.name)))
}

/// Refuses a folder that holds something: nothing is ever overwritten.
fn check_is_new(out: &Path) -> Result<(), CliError> {
    let is_empty = !out.exists() || fs::read_dir(out).is_ok_and(|mut entries| entries.next().is_none());
    if is_empty {
        return Ok(());
    }
    Err(CliError::bad_input(format!("--out {}: exists already; name a new folder", out.display())))
}

fn text_of(file: &Path) -> Result<FileText, CliError> {
    FileText::load(file).map_err(CliError::bad_input)
}

/// Writes the found configuration, with what it has from the folder.
fn write(found: &FoundFiles, folder: &Path, out: &Path) -> Result<(), CliError> {
    let mut files = vec![
        ("mechanism.toml", found.mechanism.clone()),
        ("nominal_half_step.csv", found.nominal.clone()),
        ("paper.toml", found.reading.clone()),
    ];
    for name in COPIED {
        let file = folder.join(name);
        if file.exists() {
            files.push((name, text_of(&file)?.text));
        }
    }
    OutputFolder::open(out, false)?.write(&files)?;
    let in_folder =
        |file: &FileText| Some((Path::new(&file.name).file_name()?.to_str()?.to_owned(), file.text.clone()));
    let scenarios: Vec<_> = found.scenarios.iter().filter_map(in_folder).collect();
    OutputFolder::open(&out.join(SCENARIOS), false)?.write(&scenarios)
}
