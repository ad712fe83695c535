//! What a search starts from: the files of a configuration folder.

use gait::Robot;
use interface::Command;
use model::{Joint, Sole};
use nalgebra::Vector2;
use synthesis::SynthesisParameters;

use super::candidate::Candidate;
use super::error::SearchError;
use super::files::{FileText, FoundFiles, MechanismFile, mechanism_file};
use super::open_number::{OPEN_COUNT, OPEN_NUMBERS, Open};
use super::toml_values::replaced;
use super::verdicts::Verdicts;
use crate::{LeanAt, PaperLean, PaperVerdict, Reading, Scenario, SteadyHalfStep, zmp_by_newton_euler};

/// What a search starts from.
#[derive(Clone, Debug)]
pub struct SearchBase {
    /// The mechanisms: that of the folder, then other readings of the axes.
    pub(super) mechanisms: Vec<MechanismFile>,
    /// The text of the reading's file.
    reading_text: String,
    /// The scenarios of which the paper states a verdict.
    pub(super) scenarios: Vec<Scenario>,
    /// The verdicts with the folder's own robot and reading.
    pub(super) before: Verdicts,
    /// The candidate nearest to them.
    pub(super) nearest: Candidate,
}

impl SearchBase {
    /// Reads what a search starts from.
    ///
    /// * `mechanisms` – the mechanism's file of the folder, then other readings of the axes
    /// * `robot` – the robot of the folder
    /// * `reading` – the reading of the folder, and `reading_text` its file's text
    ///
    /// # Errors
    /// A mechanism was imported or has no pelvis between its hips, so that its file cannot be scaled; the robot cannot
    /// turn or extend its steps.
    pub fn new(
        mechanisms: Vec<FileText>,
        robot: &Robot,
        reading: Reading,
        reading_text: String,
        scenarios: Vec<Scenario>,
    ) -> Result<Self, SearchError> {
        let mechanisms = mechanisms.into_iter().map(mechanism_file).collect::<Result<Vec<_>, _>>()?;
        let scenarios: Vec<Scenario> =
            scenarios.into_iter().filter(|scenario| scenario.paper_verdict != PaperVerdict::NotStated).collect();
        let before = Verdicts::of_paths(&scenarios, &paths(robot, reading, &scenarios)?, &robot.mechanism.sole);
        let nearest = nearest(robot, reading, &scenarios)?;
        Ok(Self { mechanisms, reading_text, scenarios, before, nearest })
    }

    /// The candidate nearest to the folder's robot and reading.
    pub fn nearest(&self) -> &Candidate {
        &self.nearest
    }

    /// The names of the mechanisms' files.
    pub fn axes(&self) -> Vec<&str> {
        self.mechanisms.iter().map(|file| file.name.as_str()).collect()
    }

    /// The scenarios of which the paper states a verdict.
    pub fn scenarios(&self) -> &[Scenario] {
        &self.scenarios
    }

    /// The mechanism's file that a candidate changes.
    fn file(&self, candidate: &Candidate) -> &MechanismFile {
        &self.mechanisms[candidate.mechanism]
    }

    /// The sole of a candidate.
    pub(crate) fn sole(&self, candidate: &Candidate) -> Sole {
        candidate.sole(&self.file(candidate).mechanism.sole)
    }

    /// The robot of a candidate, with a nominal half-step of its own.
    pub(crate) fn robot(&self, candidate: &Candidate) -> Result<Robot, SearchError> {
        candidate.robot(self.file(candidate))
    }

    /// The ZMP path of each scenario with a candidate, relative to O (m).
    pub(super) fn paths(&self, candidate: &Candidate) -> Result<Vec<Vec<Vector2<f64>>>, SearchError> {
        self.paths_of(&self.robot(candidate)?, candidate)
    }

    fn paths_of(&self, robot: &Robot, candidate: &Candidate) -> Result<Vec<Vec<Vector2<f64>>>, SearchError> {
        let scenarios: Vec<Scenario> = self.scenarios.iter().map(|scenario| candidate.scenario(scenario)).collect();
        paths(robot, candidate.reading, &scenarios)
    }

    /// The verdicts of a candidate.
    pub(super) fn verdicts(&self, candidate: &Candidate) -> Result<Verdicts, SearchError> {
        self.verdicts_of(&self.robot(candidate)?, candidate)
    }

    /// The verdicts of a candidate whose robot is known.
    pub(crate) fn verdicts_of(&self, robot: &Robot, candidate: &Candidate) -> Result<Verdicts, SearchError> {
        Ok(Verdicts::of_paths(&self.scenarios, &self.paths_of(robot, candidate)?, &self.sole(candidate)))
    }

    /// The files of a candidate that differ from the folder's; `scenarios` are the files of all scenarios.
    ///
    /// # Errors
    /// A file does not have the key that is to be changed.
    pub fn files(&self, candidate: &Candidate, scenarios: &[FileText]) -> Result<FoundFiles, SearchError> {
        let reading = replaced(&self.reading_text, &candidate.reading_values())
            .ok_or_else(|| SearchError::Unwritable { file: "paper.toml".to_owned() })?;
        let scenarios = scenarios.iter().map(|file| candidate.scenario_text(file)).collect::<Result<_, _>>()?;
        Ok(FoundFiles {
            mechanism: candidate.mechanism_text(self.file(candidate))?,
            nominal: candidate.robot(self.file(candidate))?.nominal.to_csv().map_err(SearchError::Table)?,
            reading,
            scenarios,
        })
    }
}

/// The candidate nearest to a robot and a reading.
fn nearest(robot: &Robot, reading: Reading, scenarios: &[Scenario]) -> Result<Candidate, SearchError> {
    let Robot { mechanism, nominal } = robot;
    let sole = mechanism.sole;
    let [first, _] = SteadyHalfStep::steady(robot, &Command::NOMINAL, reading)?;
    let default = SynthesisParameters::for_robot(mechanism);
    let extended = scenarios.iter().map(|scenario| scenario.request.extension).find(|extension| *extension != 0.0);
    let values: [(Open, f64); OPEN_COUNT] = [
        (Open::Heel, sole.behind),
        (Open::Toe, sole.ahead),
        (Open::Inside, sole.inside),
        (Open::Outside, sole.outside),
        (Open::Duration, nominal.duration),
        (Open::StepLength, first.swing.lands.translation.vector.x),
        (Open::Extension, extended.unwrap_or_default().to_degrees()),
        (Open::PelvisSway, default.pelvis_sway),
        (Open::PelvisSetback, default.pelvis_setback),
        (Open::Clearance, default.clearance),
        (Open::Stature, 1.0),
        (Open::HipDistance, mechanism.links[Joint::LeftHipRoll].origin.y),
        (Open::TrunkMass, 1.0),
        (Open::LegMass, 1.0),
        (Open::ArmMass, 1.0),
        (Open::HipHeight, 1.0),
    ];
    let grains = values.map(|(open, value)| OPEN_NUMBERS[open as usize].nearest(value));
    Ok(Candidate { grains, mechanism: 0, reading })
}

/// The ZMP path of each scenario, as [`reproduce`](crate::reproduce) computes it (m).
fn paths(robot: &Robot, reading: Reading, scenarios: &[Scenario]) -> Result<Vec<Vec<Vector2<f64>>>, SearchError> {
    let tree = dynamics::Tree::new(&robot.mechanism);
    let path = |scenario: &Scenario| {
        let command = scenario.request;
        let half_steps = SteadyHalfStep::steady(robot, &command, reading)?;
        let lean = scenario.lean.unwrap_or(PaperLean::none(LeanAt::Ankle));
        // A walk that goes straight takes the same half-step on either foot.
        let different = if command.turn == 0.0 { &half_steps[..1] } else { &half_steps[..] };
        let motions = different.iter().flat_map(|half_step| half_step.at_speed(command.speed));
        let leaning: Vec<_> = motions.map(|motion| lean.lean(&motion)).collect();
        Ok(zmp_by_newton_euler(&tree, &leaning).collect())
    };
    scenarios.iter().map(path).collect()
}
