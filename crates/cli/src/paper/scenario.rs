//! A figure of the paper as data: `config/scenarios/figure_04.toml` and so on.

use std::fs;
use std::path::{Path, PathBuf};

use balance::{LeanAt, PaperLean};
use gait::Command;
use model::config::{self, ConfigErrors, Document, Table};
use nalgebra::Vector2;

use crate::configuration::Errors;

/// What the paper did, and what it saw.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// The paper's number.
    pub figure: u64,
    /// The gait, for people.
    pub title: String,
    /// What is in force throughout.
    pub request: Command,
    /// What the paper added against falling over.
    pub lean: Option<PaperLean>,
    /// What the paper says about the ZMP.
    pub paper_verdict: PaperVerdict,
    /// What else there is to say, for people.
    pub note: Option<String>,
}

/// What the paper says about the ZMP.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaperVerdict {
    /// Every point is inside the sole.
    In,
    /// Some point is outside.
    Out,
    /// Nothing.
    NotStated,
}

impl PaperVerdict {
    /// As in the files and on screens.
    pub const fn text(self) -> &'static str {
        match self {
            PaperVerdict::In => "in",
            PaperVerdict::Out => "out",
            PaperVerdict::NotStated => "not stated",
        }
    }

    /// Whether a ZMP path that is `inside` the sole is what the paper says; `None` when it says nothing.
    pub fn agrees(self, inside: bool) -> Option<bool> {
        match self {
            PaperVerdict::In => Some(inside),
            PaperVerdict::Out => Some(!inside),
            PaperVerdict::NotStated => None,
        }
    }
}

impl Scenario {
    /// Reads every `figure_*.toml` of a folder, in the order of the figures' numbers. Notes what is wrong.
    pub fn load_all(folder: &Path, errors: &mut Errors) -> Vec<Self> {
        let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()));
        let Some(entries) = errors.note(entries) else { return Vec::new() };
        let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        files.retain(|file| number_in_name(file).is_some());
        files.sort();
        if files.is_empty() {
            errors.0.push(format!("{}: holds no scenario; they are named figure_04.toml and so on", folder.display()));
        }
        let mut scenarios: Vec<_> = files.iter().filter_map(|file| errors.note(Self::load(file))).collect();
        scenarios.sort_by_key(|scenario| scenario.figure);
        scenarios
    }

    /// Reads a file.
    ///
    /// # Errors
    /// When it cannot be read, and every mistake in it.
    pub fn load(file: &Path) -> Result<Self, ConfigErrors> {
        Self::from_toml(&config::read(file)?, file)
    }

    /// Reads a file's text; `file` is its name, which carries the figure's number.
    ///
    /// # Errors
    /// Every mistake: keys unknown, missing or in a wrong unit, and values out of range.
    pub fn from_toml(text: &str, file: &Path) -> Result<Self, ConfigErrors> {
        let document = Document::parse(text, &file.display().to_string())?;
        let root = document.root();
        let figure = root.integer("figure", 1, 99);
        if let Some(number) = number_in_name(file).filter(|number| *number != figure.to_string()) {
            root.refuse("figure", &format!("must be {number}, the number in the file's name"));
        }
        let request = root.table("request");
        let scenario = Self {
            figure,
            title: root.text("title").to_owned(),
            request: Command {
                turn: request.angle("turn_deg").between(-45.0, 45.0),
                speed: request.number("speed").between(0.1, 2.0),
                extension: request.angle("extension_deg").between(-20.0, 20.0),
            },
            lean: root.has("lean").then(|| lean(&root.table("lean"))),
            paper_verdict: paper_verdict(&root),
            note: root.has("note").then(|| root.text("note").to_owned()),
        };
        document.finish(scenario)
    }
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
