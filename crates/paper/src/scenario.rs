//! Scenarios: figures of the paper as data, `config/scenarios/figure_04.toml` and so on.

use std::fs;
use std::path::{Path, PathBuf};

use config::{Config, ConfigError, ConfigErrors, Table};
use interface::Command;
use nalgebra::Vector2;

use crate::{FileText, LeanAt, PaperLean};

/// What the paper did, and what it saw.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Number of the figure in the paper.
    pub figure: u64,
    /// Title of the figure, for users.
    pub title: String,
    /// The command in force throughout.
    pub request: Command,
    /// The constant lean that the paper adds, if it adds one.
    pub lean: Option<PaperLean>,
    /// What the paper states about the ZMP.
    pub paper_verdict: PaperVerdict,
    /// A note for users, if there is one.
    pub note: Option<String>,
}

/// What the paper states about the ZMP.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaperVerdict {
    /// Every point of the ZMP path is inside the sole.
    In,
    /// Some point of the ZMP path is outside the sole.
    Out,
    /// The paper does not state where the ZMP is.
    NotStated,
}

impl PaperVerdict {
    /// The verdict in files and tables.
    pub const fn text(self) -> &'static str {
        match self {
            PaperVerdict::In => "in",
            PaperVerdict::Out => "out",
            PaperVerdict::NotStated => "not stated",
        }
    }

    /// Whether a ZMP path that is `inside` the sole, or not, agrees with the paper; `None` when the paper states
    /// nothing.
    pub fn agrees(self, inside: bool) -> Option<bool> {
        match self {
            PaperVerdict::In => Some(inside),
            PaperVerdict::Out => Some(!inside),
            PaperVerdict::NotStated => None,
        }
    }
}

impl Scenario {
    /// Reads every `figure_*.toml` of a folder, in the order of the figures' numbers.
    ///
    /// # Errors
    /// The folder cannot be read or has no scenario, or every mistake in every file.
    pub fn load_all(folder: &Path) -> Result<Vec<Self>, ConfigErrors> {
        Self::read_all(&Self::texts_in(folder)?)
    }

    /// The text of every `figure_*.toml` of a folder, in the order of their names.
    ///
    /// # Errors
    /// The folder or a file cannot be read, or there is no such file.
    pub fn texts_in(folder: &Path) -> Result<Vec<FileText>, ConfigErrors> {
        let of_folder = |message: String| ConfigErrors(vec![of_folder(folder, message)]);
        let entries = fs::read_dir(folder).map_err(|error| of_folder(error.to_string()))?;
        let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        files.retain(|file| number_in_name(file).is_some());
        files.sort();
        if files.is_empty() {
            return Err(of_folder("holds no scenario; they are named figure_04.toml and so on".to_owned()));
        }
        all_of(files.iter().map(|file| FileText::load(file)))
    }

    /// Reads the texts of scenarios' files, and sorts them by the figures' numbers.
    ///
    /// # Errors
    /// Every mistake in every text.
    pub fn read_all(texts: &[FileText]) -> Result<Vec<Self>, ConfigErrors> {
        let mut scenarios = all_of(texts.iter().map(|file| Self::from_toml(&file.text, &file.name)))?;
        scenarios.sort_by_key(|scenario| scenario.figure);
        Ok(scenarios)
    }
}

/// All values, or all errors.
fn all_of<T>(results: impl Iterator<Item = Result<T, ConfigErrors>>) -> Result<Vec<T>, ConfigErrors> {
    let (mut values, mut errors) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(wrong) => errors.extend(wrong.0),
        }
    }
    if errors.is_empty() { Ok(values) } else { Err(ConfigErrors(errors)) }
}

/// The file's name carries the figure's number.
impl Config for Scenario {
    fn read(root: &Table) -> Self {
        let figure = root.integer("figure", 1, 99);
        if let Some(number) = number_in_name(Path::new(root.file())).filter(|number| *number != figure.to_string()) {
            root.refuse("figure", &format!("must be {number}, the number in the file's name"));
        }
        let request = root.table("request");
        Self {
            figure,
            title: root.text("title").to_owned(),
            request: Command {
                turn: request.angle("turn_deg").between(-45.0, 45.0),
                speed: request.number("speed").between(0.1, 2.0),
                extension: request.angle("extension_deg").between(-20.0, 20.0),
                sidestep: 0.0,
            },
            lean: root.has("lean").then(|| lean(&root.table("lean"))),
            paper_verdict: paper_verdict(root),
            note: root.has("note").then(|| root.text("note").to_owned()),
        }
    }
}

/// A mistake about a folder as a whole.
fn of_folder(folder: &Path, message: String) -> ConfigError {
    ConfigError { file: folder.display().to_string(), line: 0, column: 0, path: String::new(), found: None, message }
}

fn lean(table: &Table) -> PaperLean {
    let at = table.choice("at", [("ankle", LeanAt::Ankle), ("trunk", LeanAt::Trunk)]).unwrap_or(LeanAt::Ankle);
    let small = |angles: &[f64; 2]| angles.iter().all(|angle| angle.abs() <= 45.0);
    let angles =
        table.angles("angles_deg").that(small, "must be two angles of at most 45°, for joints 3 and 4 or 15 and 16");
    PaperLean { at, angles: Vector2::from(angles) }
}

fn paper_verdict(root: &Table) -> PaperVerdict {
    let verdicts = [PaperVerdict::In, PaperVerdict::Out, PaperVerdict::NotStated];
    let named = verdicts.map(|verdict| (verdict.text(), verdict));
    root.choice("paper_verdict", named).unwrap_or(PaperVerdict::NotStated)
}

/// `7` of `figure_07.toml`.
fn number_in_name(file: &Path) -> Option<String> {
    let digits = file.file_name()?.to_str()?.strip_prefix("figure_")?.strip_suffix(".toml")?;
    digits.parse::<u64>().ok().map(|number| number.to_string())
}
