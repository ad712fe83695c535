//! `halfstep import`: another biped from its URDF.

use std::fs;
use std::path::{Path, PathBuf};

use model::{Joint, Mechanism};
use serde::Serialize;

use super::{print_json, print_line};
use crate::failure::{Failure, Outcome};
use crate::import::{NamedText, import};

/// Read another biped from its URDF: a configuration folder for it, all but its half-step
#[derive(Clone, Debug, clap::Args)]
pub struct Import {
    /// The biped
    urdf: PathBuf,
    /// Which of its joints is which of ours, its soles and motors; see docs/import.md
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    /// Folder to write mechanism.toml into, and controller.toml and plant.toml if it has none
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Folder to take controller.toml and plant.toml from
    #[arg(long, value_name = "DIR", default_value = "config")]
    parameters: PathBuf,
}

/// What came of it.
#[derive(Debug, Serialize)]
struct ImportInJson {
    name: String,
    mass_kg: f64,
    leg_m: f64,
    changes: Vec<String>,
    written: Vec<PathBuf>,
    synthesize: String,
}

impl Import {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let (urdf, map) = (read(&self.urdf)?, read(&self.map)?);
        let (urdf_file, map_file) = (self.urdf.display().to_string(), self.map.display().to_string());
        let imported = import(NamedText { text: &urdf, file: &urdf_file }, NamedText { text: &map, file: &map_file })?;

        let mechanism_file = self.out.join("mechanism.toml");
        fs::create_dir_all(&self.out).map_err(|error| cannot(&self.out, &error))?;
        fs::write(&mechanism_file, &imported.text).map_err(|error| cannot(&mechanism_file, &error))?;
        let mut written = vec![mechanism_file];
        for name in ["controller.toml", "plant.toml"] {
            let (from, to) = (self.parameters.join(name), self.out.join(name));
            if !to.exists() {
                fs::copy(&from, &to).map_err(|error| cannot(&from, &error))?;
                written.push(to);
            }
        }

        let mechanism = imported.mechanism;
        let report = ImportInJson {
            mass_kg: mechanism.mass(),
            leg_m: leg_length(&mechanism),
            synthesize: synthesize_line(&mechanism, &self.out),
            name: mechanism.name,
            changes: imported.changes,
            written,
        };
        if json {
            print_json(&report)?
        } else {
            print_line(in_words(&report))?
        }
        Ok(Outcome::Fine)
    }
}

fn read(file: &Path) -> Result<String, Failure> {
    model::config::read(file).map_err(Failure::bad_input)
}

fn cannot(path: &Path, error: &std::io::Error) -> Failure {
    Failure::new(format!("{}: {error}", path.display()))
}

/// Hip to ankle of the stretched leg [m].
fn leg_length(mechanism: &Mechanism) -> f64 {
    [Joint::LeftKnee, Joint::LeftAnklePitch].iter().map(|joint| mechanism.links[*joint].origin.norm()).sum()
}

/// The default half-step in the leg's proportions: lengths as the leg, time as its root (Froude's law).
fn synthesize_line(mechanism: &Mechanism, folder: &Path) -> String {
    /// Leg of the robot for which the defaults were chosen [m].
    const DEFAULT_LEG: f64 = 0.856;
    /// Its ankle above the sole [m].
    const DEFAULT_ANKLE: f64 = 0.07;
    let default = synthesis::Parameters::default();
    let leg = leg_length(mechanism);
    let scale = leg / DEFAULT_LEG;
    let hip_height = mechanism.sole.ankle_height + (default.hip_height - DEFAULT_ANKLE) * scale;
    let folder = folder.display();
    format!(
        "halfstep synthesize --mechanism {folder}/mechanism.toml --out {folder}/nominal_half_step.csv --step-length {:.3} \
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

fn in_words(report: &ImportInJson) -> String {
    let mut text = format!("{}: {:.2} kg, legs of {:.3} m\n", report.name, report.mass_kg, report.leg_m);
    for change in &report.changes {
        text += &format!("  {change}\n");
    }
    for file in &report.written {
        text += &format!("written to {}\n", file.display());
    }
    text + &format!("its half-step next, for example:\n  {}", report.synthesize)
}
