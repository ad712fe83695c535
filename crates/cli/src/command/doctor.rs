//! `halfstep doctor`: checks a configuration one thing after the other, up to walking, and names the key to turn.

use std::path::{Path, PathBuf};

use doctor::{ExaminedRobot, Finding, Remedy, examine};
use node::configuration::Errors;
use node::realtime::RealtimeParameters;
use robots::BuiltInRobot;
use serde::Serialize;

use super::config_options::ConfigOptions;
use crate::error::CliError;
use crate::output::{print_json, print_line};
use crate::status::Status;

/// Check model, drives, sensors, timing and first steps one after the other; name the first thing that is wrong, and
/// the key to turn
#[derive(Clone, Debug, clap::Args)]
pub(super) struct DoctorArgs {
    #[command(flatten)]
    config: ConfigOptions,
}

/// All findings.
#[derive(Debug, Serialize)]
struct Diagnosis {
    healthy: bool,
    checks: Vec<Checked>,
}

/// One finding.
#[derive(Debug, Serialize)]
struct Checked {
    check: &'static str,
    ok: bool,
    figure: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    wrong: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    turn: Vec<KeyToTurn>,
}

/// A key to turn.
#[derive(Debug, Serialize)]
struct KeyToTurn {
    file: PathBuf,
    key: String,
    advice: String,
}

/// Width of the column with the names of the checks.
const NAME_WIDTH: usize = 26;

impl DoctorArgs {
    pub(super) fn run(mut self, json: bool) -> Result<Status, CliError> {
        self.config.resolve()?;
        let mut errors = Errors::default();
        let files = self.config.files();
        let loaded = files.robot(&mut errors).zip(files.controller(&mut errors));
        let loaded = loaded.zip(files.plant(&mut errors)).zip(files.realtime(&mut errors));
        let (((robot, controller), plant), realtime) = errors.finish(loaded)?;
        let paper = BuiltInRobot::of_the_paper().parameter_texts();
        let period = realtime.rate.period_s();
        let examined = ExaminedRobot::new(&robot, controller, plant, period, paper).map_err(CliError::new)?;

        let (mut checks, mut printed) = (Vec::new(), Ok(()));
        let healthy = examine(&examined, &timing(&realtime), |finding| {
            let checked = Checked::of(finding, &files.folder);
            if !json && printed.is_ok() {
                printed = print_line(checked.text());
            }
            checks.push(checked);
        });
        printed?;
        if json {
            print_json(&Diagnosis { healthy, checks })?;
        }
        Ok(Status::success_if(healthy))
    }
}

/// What the machine permits of what the loops ask for: without it they run on, but not in real time.
fn timing(realtime: &RealtimeParameters) -> Finding {
    let scheduling = realtime.controller;
    // In a thread of its own, which is over before the robot is simulated.
    let refused =
        std::thread::spawn(move || scheduling.request().refused.iter().map(ToString::to_string).collect::<Vec<_>>());
    let refused = refused.join().unwrap_or_default();
    let rights = if refused.is_empty() {
        "all that realtime.toml asks for is permitted".to_owned()
    } else {
        format!("the loops run on without: {}", refused.join("; "))
    };
    Finding::good("timing", format!("{} Hz; {rights}", realtime.rate.hz()))
}

impl Checked {
    fn of(finding: &Finding, folder: &Path) -> Self {
        let key = |Remedy { file, key, advice }: &Remedy| KeyToTurn {
            file: folder.join(file),
            key: key.clone(),
            advice: advice.clone(),
        };
        Self {
            check: finding.check,
            ok: finding.wrong.is_none(),
            figure: finding.figure.clone(),
            wrong: finding.wrong.clone(),
            turn: finding.remedies.iter().map(key).collect(),
        }
    }

    fn text(&self) -> String {
        let verdict = if self.ok { "ok   " } else { "WRONG" };
        let mut text = format!("{verdict}  {:NAME_WIDTH$}{}", self.check, self.figure);
        if let Some(wrong) = &self.wrong {
            text += &format!("\n       {wrong}");
        }
        for KeyToTurn { file, key, advice } in &self.turn {
            text += &format!("\n       turn {}:{key} ({advice})", file.display());
        }
        text
    }
}
