//! `halfstep check`: is the configuration right, and what robot and walk is it?

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};

use dynamics::{Kinematics, Tree, zmp};
use model::{JointVector, Mechanism, Side};
use plant::Disturbances;
use serde::Serialize;
use synthesis::{Recording, StickFigure};

use super::print;
use crate::configuration::{ConfigOptions, Errors, Robot};
use crate::failure::{Failure, Outcome};
use crate::paper::{Reading, Scenario};
use crate::script::{self, ScriptError};

/// Read every configuration file, and list every error of all of them, or the facts
#[derive(Clone, Debug, clap::Args)]
pub struct Check {
    #[command(flatten)]
    config: ConfigOptions,
}

/// The robot and its walk in a few numbers.
#[derive(Debug, Serialize)]
struct Facts {
    name: String,
    fingerprint: String,
    mass_kg: f64,
    standing_height_m: f64,
    step_length_m: f64,
    half_step_s: f64,
    walking_speed_m_per_s: f64,
    zmp_residual_mm: f64,
}

impl Check {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let mut errors = Errors::default();
        let robot = self.config.robot(&mut errors);
        self.config.controller(&mut errors);
        self.config.plant(&mut errors);
        self.config.realtime(&mut errors);
        check_others(&self.config, &mut errors);
        let facts = Facts::of(&errors.finish(robot)?);
        print(json, &facts)?;
        Ok(Outcome::Fine)
    }
}

/// Checks what else lies in the folder: other mechanisms, recordings, scripts, disturbances, the paper's figures.
fn check_others(config: &ConfigOptions, errors: &mut Errors) {
    // A folder that cannot be read was noted already, once for each file that must be there.
    let Ok(entries) = fs::read_dir(&config.config) else { return };
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    for file in files.iter().filter(|file| **file != config.mechanism_file()) {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with("mechanism") && name.ends_with(".toml") {
            errors.note(Mechanism::load(file));
        } else if name.starts_with("disturbances") && name.ends_with(".toml") {
            errors.note(Disturbances::load(file));
        } else if name.starts_with("recorded") && name.ends_with(".csv") {
            errors.note(Recording::load(file));
        } else if name.ends_with(".jsonl") {
            check_script(file, errors);
        } else if name == "paper.toml" {
            errors.note(Reading::load(file));
        } else if name == "scenarios" {
            Scenario::load_all(file, errors);
        }
    }
}

fn check_script(file: &Path, errors: &mut Errors) {
    let name = file.display().to_string();
    let Some(text) = errors.note(fs::read_to_string(file).map_err(|error| format!("{name}: {error}"))) else { return };
    if let Err(wrong) = script::Reader::read_all(name, &text) {
        errors.0.extend(wrong.iter().map(ScriptError::to_string));
    }
}

impl Facts {
    fn of(Robot { mechanism, nominal }: &Robot) -> Self {
        let tree = Tree::new(mechanism);
        let standing = Kinematics::standing(&tree, &JointVector::ZERO);
        let start = Kinematics::standing(&tree, &nominal.at(0.0).angles);
        let step_length = -start.sole_to_world(mechanism, Side::Left).translation.x;
        let residuals = nominal.rows.iter().map(|row| zmp(&(row.ground_gravity + row.ground_dynamic)));
        let residual = residuals.map(|zmp| zmp.map_or(f64::INFINITY, |zmp| zmp.norm())).fold(0.0, f64::max);
        Self {
            name: mechanism.name.clone(),
            fingerprint: format!("{:#018x}", mechanism.fingerprint),
            mass_kg: mechanism.mass(),
            standing_height_m: StickFigure::new(mechanism, &standing).head.z,
            step_length_m: step_length,
            half_step_s: nominal.duration,
            walking_speed_m_per_s: step_length / nominal.duration,
            zmp_residual_mm: residual * 1e3,
        }
    }
}

impl Display for Facts {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        writeln!(out, "mechanism         {}", self.name)?;
        writeln!(out, "fingerprint       {}", self.fingerprint)?;
        writeln!(out, "mass              {:.2} kg", self.mass_kg)?;
        writeln!(out, "standing height   {:.2} m", self.standing_height_m)?;
        writeln!(out, "step length       {:.3} m", self.step_length_m)?;
        writeln!(out, "half-step, T      {:.3} s", self.half_step_s)?;
        writeln!(out, "walking speed     {:.3} m/s", self.walking_speed_m_per_s)?;
        write!(out, "residual |ZMP−O|  {:.3} mm", self.zmp_residual_mm)
    }
}
