//! A candidate: one body, one walk and one reading, as the files that `halfstep paper` reads.

use std::sync::Arc;

use config::Config;
use gait::Robot;
use model::{Joint, Mechanism, Sole};
use nalgebra::Vector3;
use synthesis::{LegPattern, SynthesisParameters, synthesize};

use super::error::SearchError;
use super::files::{FileText, MechanismFile};
use super::open_number::{OPEN_COUNT, OPEN_NUMBERS, Open, SOLE_COUNT};
use super::toml_values::replaced;
use crate::{RAMPS, Reading, Scenario};

/// One body, one walk and one reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// Values of the open numbers, in grains.
    pub grains: [i32; OPEN_COUNT],
    /// The mechanism's file: which way joints turn.
    pub mechanism: usize,
    /// How turn and extension grow.
    pub reading: Reading,
}

impl Candidate {
    /// The value of an open number, in its unit.
    pub fn value(&self, open: Open) -> f64 {
        OPEN_NUMBERS[open as usize].value(self.grains[open as usize])
    }

    /// The same candidate with another value of an open number.
    #[must_use]
    pub fn with(mut self, open: usize, grains: i32) -> Self {
        self.grains[open] = grains;
        self
    }

    /// The same body and half-step, with the sole, the extended steps and the reading of `other`, on which the
    /// half-step does not depend.
    pub(crate) fn with_sole_and_reading_of(mut self, other: &Self) -> Self {
        for open in (0..SOLE_COUNT).chain([Open::Extension as usize]) {
            self.grains[open] = other.grains[open];
        }
        Self { reading: other.reading, ..self }
    }

    /// Whether every open number is within its plausible range.
    pub fn is_plausible(&self) -> bool {
        OPEN_NUMBERS.iter().zip(self.grains).all(|(number, grains)| (number.min..=number.max).contains(&grains))
    }

    /// The text of its mechanism's file.
    pub(super) fn mechanism_text(&self, file: &MechanismFile) -> Result<String, SearchError> {
        replaced(&file.text, &self.mechanism_values(&file.mechanism))
            .ok_or_else(|| SearchError::Unwritable { file: file.name.clone() })
    }

    /// The robot, with a nominal half-step of its own, read from the texts of its files.
    pub(super) fn robot(&self, file: &MechanismFile) -> Result<Robot, SearchError> {
        let text = self.mechanism_text(file)?;
        let mechanism = Mechanism::from_toml(&text, &file.name)?;
        let parameters = self.parameters(&mechanism);
        let nominal = synthesize(&mechanism, &LegPattern::Pendulum, &parameters, &self.made_by(&parameters))?.table;
        Ok(Robot { mechanism, nominal: Arc::new(nominal) })
    }

    /// The scenario with the candidate's length of an extended step.
    pub(crate) fn scenario(&self, scenario: &Scenario) -> Scenario {
        let mut scenario = scenario.clone();
        if scenario.request.extension != 0.0 {
            scenario.request.extension = self.value(Open::Extension).to_radians();
        }
        scenario
    }

    /// The text of a scenario's file with the candidate's length of an extended step.
    pub(super) fn scenario_text(&self, file: &FileText) -> Result<FileText, SearchError> {
        let scenario = Scenario::from_toml(&file.text, &file.name)?;
        if scenario.request.extension == 0.0 {
            return Ok(file.clone());
        }
        let value = ("request.extension_deg".to_owned(), self.value(Open::Extension).to_string());
        let text = replaced(&file.text, &[value]).ok_or_else(|| SearchError::Unwritable { file: file.name.clone() })?;
        Ok(FileText { text, ..file.clone() })
    }

    /// Its sole.
    pub(super) fn sole(&self, of_file: &Sole) -> Sole {
        Sole {
            behind: self.value(Open::Heel),
            ahead: self.value(Open::Toe),
            inside: self.value(Open::Inside),
            outside: self.value(Open::Outside),
            ankle_height: of_file.ankle_height * self.value(Open::Stature),
        }
    }

    /// Keys and values of the reading's file.
    pub(super) fn reading_values(&self) -> Vec<(String, String)> {
        [("ramp.turn", self.reading.turn), ("ramp.extension", self.reading.extension)]
            .map(|(key, kind)| {
                let name = RAMPS.iter().find(|(_, known)| *known == kind).map_or("quintic", |(name, _)| name);
                (key.to_owned(), format!("\"{name}\""))
            })
            .into()
    }

    /// Parameters of the half-step: those of the robot's proportions but for the open ones.
    fn parameters(&self, mechanism: &Mechanism) -> SynthesisParameters {
        let default = SynthesisParameters::for_robot(mechanism);
        SynthesisParameters {
            step_length: self.value(Open::StepLength),
            duration: self.value(Open::Duration),
            pelvis_sway: self.value(Open::PelvisSway),
            pelvis_setback: self.value(Open::PelvisSetback),
            clearance: self.value(Open::Clearance),
            hip_height: default.hip_height * self.value(Open::HipHeight),
            ..default
        }
    }

    /// The command that makes the same half-step in the folder of the candidate.
    fn made_by(&self, parameters: &SynthesisParameters) -> String {
        let command = format!(
            "halfstep synthesize --mechanism mechanism.toml --out nominal_half_step.csv --step-length {} --duration {} \
             --clearance {} --pelvis-sway {} --pelvis-setback {}",
            self.value(Open::StepLength),
            self.value(Open::Duration),
            self.value(Open::Clearance),
            self.value(Open::PelvisSway),
            self.value(Open::PelvisSetback),
        );
        if self.value(Open::HipHeight) == 1.0 {
            return command;
        }
        format!("{command} --hip-height {}", parameters.hip_height)
    }

    /// How many times as heavy as in the file the link of a joint is; the pelvis is what the others are compared with.
    fn mass_share(&self, joint: Joint) -> f64 {
        match joint {
            Mechanism::TRUNK => self.value(Open::TrunkMass),
            Joint::RightHipRoll | Joint::WaistPitch => 1.0,
            joint if joint.is_in_arm() => self.value(Open::ArmMass),
            _ => self.value(Open::LegMass),
        }
    }

    /// Keys and values that differ from those of the mechanism's file. A greater stature lengthens all segments, at the
    /// same masses: the ZMP depends on their ratios only. A distance or share of the file itself keeps its digits.
    fn mechanism_values(&self, of_file: &Mechanism) -> Vec<(String, String)> {
        let mut values = Vec::new();
        let mut set = |path: String, value: String| values.push((path, value));
        for (key, open) in [("behind_m", Open::Heel), ("ahead_m", Open::Toe)] {
            set(format!("sole.{key}"), self.value(open).to_string());
        }
        for (key, open) in [("inside_m", Open::Inside), ("outside_m", Open::Outside)] {
            set(format!("sole.{key}"), self.value(open).to_string());
        }
        let stature = self.value(Open::Stature);
        let wider = self.value(Open::HipDistance) / of_file.links[Joint::LeftHipRoll].origin.y / stature;
        if stature != 1.0 {
            set("sole.ankle_height_m".to_owned(), (of_file.sole.ankle_height * stature).to_string());
        }
        for (joint, link) in of_file.links.iter() {
            let mut set_vector = |key: &str, before: Vector3<f64>, after: Vector3<f64>| {
                if before != after {
                    set(format!("joint.{}.{key}", joint.name()), format!("[{}, {}, {}]", after.x, after.y, after.z));
                }
            };
            let between_hips = |at: Vector3<f64>, is_there: bool| {
                if is_there { Vector3::new(at.x, at.y * wider, at.z) } else { at }
            };
            let on_pelvis = link.parent == Some(Joint::RightHipRoll);
            let is_pelvis = joint == Joint::RightHipRoll;
            set_vector("origin_m", link.origin, between_hips(link.origin, on_pelvis) * stature);
            if link.body.mass == 0.0 {
                continue;
            }
            let heavier = self.mass_share(joint);
            set_vector("com_m", link.body.com, between_hips(link.body.com, is_pelvis) * stature);
            set_vector("inertia_kg_m2", link.body.inertia, link.body.inertia * (stature * stature * heavier));
            if heavier != 1.0 {
                set(format!("joint.{}.mass_kg", joint.name()), (link.body.mass * heavier).to_string());
            }
        }
        values
    }
}
