//! `halfstep import`: another biped from its URDF, as a complete configuration folder.

use std::fmt;
use std::path::{Path, PathBuf};

use interchange::import::{JointRole, NamedText, print_map};
use model::Side;
use node::tell::tell;
use robots::{ImportedRobot, URDF};
use serde::Serialize;

use crate::error::CliError;
use crate::output::{print, print_json, print_line, quoted};
use crate::output_folder::OutputFolder;
use crate::status::Status;

/// Import a biped from its URDF into a configuration folder from which it walks
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ImportArgs {
    /// URDF of the biped
    urdf: PathBuf,
    /// What a URDF lacks, name and sole, and what is to be other than found; see docs/import.md
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Folder to write: mechanism, nominal half-step, parameters, and a copy of the URDF
    #[arg(long, value_name = "DIR", required_unless_present = "print_map")]
    out: Option<PathBuf>,
    /// Print the map with all roles that are found, and write nothing
    #[arg(long)]
    print_map: bool,
    /// Replace another robot in the folder
    #[arg(long)]
    force: bool,
}

/// The map with all roles.
#[derive(Debug, Serialize)]
struct PrintedMap<'a> {
    map: &'a str,
}

impl fmt::Display for PrintedMap<'_> {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(self.map)
    }
}

/// Result of the import.
#[derive(Debug, Serialize)]
struct ImportReport {
    name: String,
    mass_kg: f64,
    leg_m: f64,
    /// What was taken, assumed, held and changed.
    notes: Vec<String>,
    step_length_m: f64,
    half_step_s: f64,
    /// How far the shoulders swing forward and backward, and the elbows are bent; `None` where arms are held.
    arm_swing_deg: Option<f64>,
    elbow_flexion_deg: Option<f64>,
    zmp_residual_mm: f64,
    /// Largest share of a torque or rate limit that the half-step needs, and where.
    load_share: f64,
    load_joint: &'static str,
    written: Vec<PathBuf>,
    walk: String,
}

impl ImportArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let urdf = read(&self.urdf)?;
        let map = self.map.as_deref().map(read).transpose()?;
        let (urdf_file, map_file) = (name_of(&self.urdf), self.map.as_deref().map(name_of).unwrap_or_default());
        let urdf_text = NamedText { text: &urdf, file: &urdf_file };
        let map_text = map.as_deref().map(|text| NamedText { text, file: &map_file });
        if self.print_map {
            let map = print_map(urdf_text, map_text)?;
            print(json, &PrintedMap { map: map.trim_end() })?;
            return Ok(Status::Success);
        }
        let Some(out) = self.out else { return Err(CliError::bad_input("--out must name a folder")) };

        let folder = OutputFolder::open(&out, self.force)?;
        tell(format_args!("import: looks for a half-step that suits the robot of {urdf_file}"));
        let robot = ImportedRobot::new(urdf_text, map_text)?;
        let mut files = robot.files.to_vec();
        files.push((URDF, urdf.clone()));
        folder.write(&files)?;

        let written = files.iter().map(|(name, _)| out.join(name)).collect();
        let report = ImportReport::new(robot, written, &out);
        if json {
            print_json(&report)?;
        } else {
            print_line(report.in_words())?;
        }
        Ok(Status::Success)
    }
}

fn read(file: &Path) -> Result<String, CliError> {
    config::read_text(file).map_err(CliError::bad_input)
}

fn name_of(file: &Path) -> String {
    file.display().to_string()
}

impl ImportReport {
    fn new(robot: ImportedRobot, written: Vec<PathBuf>, folder: &Path) -> Self {
        let ImportedRobot { imported, half_step, .. } = robot;
        let (load_share, joint) = half_step.load;
        let has = |wanted: JointRole| imported.roles.iter().any(|(role, _)| *role == wanted);
        let parameters = half_step.parameters;
        let arm_swing_deg = has(JointRole::Shoulder(Side::Right)).then_some(parameters.arm_swing.to_degrees());
        let elbow_flexion_deg = has(JointRole::Elbow(Side::Right)).then_some(parameters.elbow_flexion.to_degrees());
        Self {
            arm_swing_deg,
            elbow_flexion_deg,
            name: imported.name,
            mass_kg: imported.mass,
            leg_m: imported.leg,
            notes: imported.lines,
            step_length_m: parameters.step_length,
            half_step_s: parameters.duration,
            zmp_residual_mm: half_step.synthesis.report.residual * 1e3,
            load_share,
            load_joint: joint.name(),
            written,
            walk: format!("halfstep walk --config {}", quoted(&folder.display().to_string())),
        }
    }

    fn in_words(&self) -> String {
        let mut text = String::new();
        for (index, note) in self.notes.iter().enumerate() {
            text += &format!("{}{note}\n", if index == 0 { "" } else { "  " });
        }
        text += &format!(
            "half-step of {:.3} m in {:.2} s: ZMP within {:.3} mm of the ankle, {} needs {:.0} % of its limit\n",
            self.step_length_m,
            self.half_step_s,
            self.zmp_residual_mm,
            self.load_joint,
            self.load_share * 100.0
        );
        if let Some(swing) = self.arm_swing_deg {
            let elbows = self.elbow_flexion_deg.map_or(String::new(), |bent| format!(", elbows bent by {bent:.0}°"));
            text += &format!("  arms swing by {swing:.0}° forward and backward{elbows}\n");
        }
        if self.load_share > 1.0 {
            text += &format!(
                "  {} is too weak for any half-step that was tried: it will yield, and requests are limited\n",
                self.load_joint
            );
        }
        for file in &self.written {
            text += &format!("written to {}\n", file.display());
        }
        text + &self.walk
    }
}
