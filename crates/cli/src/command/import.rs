//! `halfstep import`: another biped from its URDF.

use std::fs;
use std::path::{Path, PathBuf};

use interchange::import::{NamedText, import};
use model::{Joint, Mechanism};
use serde::Serialize;

use crate::error::CliError;
use crate::output::{print_json, print_line};
use crate::status::Status;

/// Import a biped from its URDF into a configuration folder (without its nominal half-step)
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ImportArgs {
    /// URDF of the biped
    urdf: PathBuf,
    /// Joint map: URDF joints, soles and motors; see docs/import.md
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    /// Folder to write mechanism.toml into, and controller.toml, plant.toml and realtime.toml if it has none
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Folder to take controller.toml, plant.toml and realtime.toml from
    #[arg(long, value_name = "DIR", default_value = "config")]
    parameters: PathBuf,
}

/// Result of the import.
#[derive(Debug, Serialize)]
struct ImportReport {
    name: String,
    mass_kg: f64,
    leg_m: f64,
    changes: Vec<String>,
    written: Vec<PathBuf>,
    synthesize: String,
}

impl ImportArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let (urdf, map) = (read(&self.urdf)?, read(&self.map)?);
        let (urdf_file, map_file) = (self.urdf.display().to_string(), self.map.display().to_string());
        let imported = import(NamedText { text: &urdf, file: &urdf_file }, NamedText { text: &map, file: &map_file })?;

        let mechanism_file = self.out.join("mechanism.toml");
        fs::create_dir_all(&self.out).map_err(CliError::file(&self.out))?;
        fs::write(&mechanism_file, &imported.text).map_err(CliError::file(&mechanism_file))?;
        let mut written = vec![mechanism_file];
        for name in ["controller.toml", "plant.toml", "realtime.toml"] {
            let (from, to) = (self.parameters.join(name), self.out.join(name));
            if !to.exists() {
                fs::copy(&from, &to).map_err(CliError::file(&from))?;
                written.push(to);
            }
        }

        let mechanism = imported.mechanism;
        let report = ImportReport {
            mass_kg: mechanism.mass(),
            leg_m: leg_length(&mechanism),
            synthesize: synthesize_line(&mechanism, &self.out),
            name: mechanism.name,
            changes: imported.changes,
            written,
        };
        if json {
            print_json(&report)?;
        } else {
            print_line(in_words(&report))?;
        }
        Ok(Status::Success)
    }
}

fn read(file: &Path) -> Result<String, CliError> {
    config::read_text(file).map_err(CliError::bad_input)
}

/// Hip to ankle of the stretched leg (m).
fn leg_length(mechanism: &Mechanism) -> f64 {
    [Joint::LeftKnee, Joint::LeftAnklePitch].iter().map(|joint| mechanism.links[*joint].origin.norm()).sum()
}

/// A command that makes a half-step for this leg length: lengths scale as the leg, times as its square root (Froude's
/// law).
fn synthesize_line(mechanism: &Mechanism, folder: &Path) -> String {
    /// Leg length of the robot for which the defaults were chosen (m).
    const DEFAULT_LEG: f64 = 0.856;
    /// Height of its ankle above the sole (m).
    const DEFAULT_ANKLE: f64 = 0.07;
    let default = synthesis::SynthesisParameters::default();
    let leg = leg_length(mechanism);
    let scale = leg / DEFAULT_LEG;
    let hip_height = mechanism.sole.ankle_height + (default.hip_height - DEFAULT_ANKLE) * scale;
    let folder = folder.display();
    format!(
        "halfstep synthesize --mechanism {folder}/mechanism.toml --out {folder}/nominal_half_step.csv --step-length \
         {:.3} \
         --duration {:.2} --clearance {:.3} --hip-height {hip_height:.3} --pelvis-sway {:.3} --pelvis-setback {:.3} \
         --pendulum-height {:.3}",
        default.step_length * scale,
        default.duration * scale.sqrt(),
        default.clearance * scale,
        default.pelvis_sway * scale,
        default.pelvis_setback * scale,
        default.pendulum_height * scale,
    )
}

fn in_words(report: &ImportReport) -> String {
    let mut text = format!("{}: {:.2} kg, legs of {:.3} m\n", report.name, report.mass_kg, report.leg_m);
    for change in &report.changes {
        text += &format!("  {change}\n");
    }
    for file in &report.written {
        text += &format!("written to {}\n", file.display());
    }
    text + &format!("make its half-step next, for example:\n  {}", report.synthesize)
}
