//! `halfstep check`: validates the configuration, and prints a summary of robot and walk.

use std::fmt::Display;
use std::fs;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use config::Config;
use dialogue::script::{self, ScriptError};
use dynamics::{Kinematics, Tree, zmp};
use gait::Robot;
use model::{JointVector, Mechanism, Side};
use node::configuration::{ConfigFiles, Errors};
use paper::{Reading, Scenario};
use plant::Disturbances;
use serde::Serialize;
use synthesis::{GaitRecording, StickFigure};

use super::config_options::ConfigOptions;
use crate::error::CliError;
use crate::output::print;
use crate::status::Status;

/// Validate all configuration files; list every error, or print a summary
#[derive(Clone, Debug, clap::Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    config: ConfigOptions,
}

/// Summary of the robot and its nominal walk.
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

impl CheckArgs {
    pub(super) fn run(mut self, json: bool) -> Result<Status, CliError> {
        self.config.resolve()?;
        let mut errors = Errors::default();
        let files = self.config.files();
        let robot = files.robot(&mut errors);
        files.controller(&mut errors);
        files.plant(&mut errors);
        files.realtime(&mut errors);
        check_others(&files, &mut errors);
        let facts = Facts::of(&errors.finish(robot)?);
        print(json, &facts)?;
        Ok(Status::Success)
    }
}

/// Checks the other files in the folder: mechanisms, recorded gaits, scripts, disturbances, the paper's figures.
fn check_others(config: &ConfigFiles, errors: &mut Errors) {
    // A folder that cannot be read has been noted already, with each file that must be in it.
    let Ok(entries) = fs::read_dir(&config.folder) else { return };
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    for file in files.iter().filter(|file| **file != config.mechanism_file()) {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with("mechanism") && name.ends_with(".toml") {
            errors.note(Mechanism::load(file));
        } else if name.starts_with("disturbances") && name.ends_with(".toml") {
            errors.note(Disturbances::load(file));
        } else if name.starts_with("recorded") && name.ends_with(".csv") {
            errors.note(GaitRecording::load(file));
        } else if name.ends_with(".jsonl") {
            check_script(file, errors);
        } else if name == "paper.toml" {
            errors.note(Reading::load(file));
        } else if name == "scenarios" {
            errors.note(Scenario::load_all(file));
        }
    }
}

fn check_script(file: &Path, errors: &mut Errors) {
    let name = file.display().to_string();
    let Some(input) = errors.note(fs::File::open(file).map_err(|error| format!("{name}: {error}"))) else { return };
    if let Err(wrong) = script::Reader::read_all(name, BufReader::new(input)) {
        errors.0.extend(wrong.iter().map(ScriptError::to_string));
    }
}

impl Facts {
    fn of(Robot { mechanism, nominal }: &Robot) -> Self {
        let tree = Tree::new(mechanism);
        let standing = Kinematics::fixed_base(&tree, &JointVector::ZERO);
        let start = Kinematics::fixed_base(&tree, &nominal.at(0.0).angles);
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
