//! `halfstep synthesize`: makes the nominal half-step.

use std::fs;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use config::Config;
use gait::NominalTable;
use model::Mechanism;
use plots::picture;
use serde::Serialize;
use synthesis::{Balance, GaitRecording, LegPattern, SynthesisParameters, SynthesisReport, synthesize};

use crate::error::CliError;
use crate::output::{print_json, print_line, quoted};
use crate::output_folder::OutputFolder;
use crate::status::Status;

/// Synthesize the nominal half-step: prescribed or recorded legs, and the trunk that keeps the ZMP under the ankle
#[derive(Clone, Debug, clap::Args)]
pub(super) struct SynthesizeArgs {
    /// Robot description
    #[arg(long, value_name = "FILE", default_value = "config/mechanism.toml")]
    mechanism: PathBuf,
    /// Output file of the half-step
    #[arg(long, value_name = "FILE", default_value = "config/nominal_half_step.csv")]
    out: PathBuf,
    /// Recorded leg motion: hip and knee flexion over the gait cycle
    #[arg(long, value_name = "FILE")]
    recorded: Option<PathBuf>,
    /// Replace another half-step in the output file, and other figures
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    parameters: ParameterOptions,
    /// Draw the half-step into this folder: stick diagram, and footprints with ZMP
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
}

/// What may differ from the default half-step.
#[derive(Clone, Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
struct ParameterOptions {
    /// Distance between the feet at the support change (m)
    #[arg(long, value_name = "M")]
    step_length: Option<f64>,
    /// Duration of the half-step (s)
    #[arg(long, value_name = "S")]
    duration: Option<f64>,
    /// Greatest height of the swing sole (m)
    #[arg(long, value_name = "M")]
    clearance: Option<f64>,
    /// Hip height at the support change (m)
    #[arg(long, value_name = "M")]
    hip_height: Option<f64>,
    /// How far the pelvis moves towards the support foot (m)
    #[arg(long, value_name = "M")]
    pelvis_sway: Option<f64>,
    /// Distance of the pelvis behind the middle between the feet at the support change (m)
    #[arg(long, value_name = "M")]
    pelvis_setback: Option<f64>,
    /// Height of the pendulum after whose motion the pelvis moves forward (m)
    #[arg(long, value_name = "M")]
    pendulum_height: Option<f64>,
    /// Shoulder swing to either side (deg)
    #[arg(long, value_name = "DEG")]
    arm_swing: Option<f64>,
    /// How far the elbows are bent (deg)
    #[arg(long, value_name = "DEG")]
    elbow_flexion: Option<f64>,
    /// Intervals of the table
    #[arg(long, value_name = "N")]
    intervals: Option<usize>,
    /// What moves to keep the ZMP under the ankle; without it the trunk, or the pelvis of a robot without a waist that
    /// pitches and rolls
    #[arg(long, value_enum)]
    balance: Option<BalanceOption>,
}

/// What moves to keep the ZMP under the ankle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum BalanceOption {
    /// The trunk; the pelvis moves as prescribed
    Trunk,
    /// The pelvis; the trunk stays upright
    Pelvis,
}

impl From<BalanceOption> for Balance {
    fn from(option: BalanceOption) -> Self {
        match option {
            BalanceOption::Trunk => Balance::Trunk,
            BalanceOption::Pelvis => Balance::Pelvis,
        }
    }
}

/// Result of the synthesis; angles in degrees.
#[derive(Debug, Serialize)]
struct SynthesisJson {
    zmp_residual_mm: f64,
    iterations: usize,
    trunk_pitch_deg: [f64; 2],
    trunk_roll_deg: [f64; 2],
    knee_flexion_min_deg: f64,
    swap_angle_rad: f64,
    swap_rate_rad_per_s: f64,
    out: PathBuf,
}

impl SynthesizeArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        if !self.mechanism.exists() {
            let file = self.mechanism.display();
            return Err(CliError::bad_input(format!(
                "{file}: does not exist; name the robot's file with --mechanism and the half-step's with --out"
            )));
        }
        let mechanism = Mechanism::load(&self.mechanism).map_err(CliError::bad_input)?;
        let pattern = match &self.recorded {
            None => LegPattern::Pendulum,
            Some(file) => LegPattern::Recorded(GaitRecording::load(file).map_err(CliError::bad_input)?),
        };
        OutputFolder::of_file(&self.out, self.force)?;
        let figures = self.figures.as_deref().map(|folder| OutputFolder::open(folder, self.force)).transpose()?;
        let made_by = self.command_line();
        let synthesis = synthesize(&mechanism, &pattern, &self.parameters.parameters(&mechanism), &made_by)
            .map_err(CliError::bad_input)?;

        if !self.force {
            keep_another(&synthesis.table, &self.out)?;
        }
        if let Some(folder) = &figures {
            folder.write(&drawn(&synthesis.table, &mechanism))?;
        }
        synthesis.table.write_csv(&self.out).map_err(CliError::new)?;

        if json {
            print_json(&SynthesisJson::new(&synthesis.report, self.out))?;
        } else {
            print_line(in_words(&synthesis.report))?;
            print_line(format_args!("written to {}", self.out.display()))?;
        }
        Ok(Status::Success)
    }

    /// The command that makes the same table.
    fn command_line(&self) -> String {
        let path = |path: &Path| quoted(&path.display().to_string());
        let mut line = format!("halfstep synthesize --mechanism {} --out {}", path(&self.mechanism), path(&self.out));
        if let Some(file) = &self.recorded {
            line += &format!(" --recorded {}", path(file));
        }
        for (option, value) in self.parameters.given() {
            line += &format!(" --{option} {value}");
        }
        line
    }
}

impl ParameterOptions {
    /// The parameters with angles in radians, and defaults in the robot's proportions for options that were not given.
    fn parameters(&self, mechanism: &Mechanism) -> SynthesisParameters {
        let default = SynthesisParameters::for_robot(mechanism);
        SynthesisParameters {
            step_length: self.step_length.unwrap_or(default.step_length),
            duration: self.duration.unwrap_or(default.duration),
            clearance: self.clearance.unwrap_or(default.clearance),
            hip_height: self.hip_height.unwrap_or(default.hip_height),
            pelvis_sway: self.pelvis_sway.unwrap_or(default.pelvis_sway),
            pelvis_setback: self.pelvis_setback.unwrap_or(default.pelvis_setback),
            pendulum_height: self.pendulum_height.unwrap_or(default.pendulum_height),
            arm_swing: self.arm_swing.map_or(default.arm_swing, f64::to_radians),
            elbow_flexion: self.elbow_flexion.map_or(default.elbow_flexion, f64::to_radians),
            intervals: self.intervals.unwrap_or(default.intervals),
            balance: self.balance.map_or(default.balance, Balance::from),
        }
    }

    /// The options that were given, with their values.
    fn given(&self) -> impl Iterator<Item = (&'static str, String)> {
        [
            ("step-length", self.step_length),
            ("duration", self.duration),
            ("clearance", self.clearance),
            ("hip-height", self.hip_height),
            ("pelvis-sway", self.pelvis_sway),
            ("pelvis-setback", self.pelvis_setback),
            ("pendulum-height", self.pendulum_height),
            ("arm-swing", self.arm_swing),
            ("elbow-flexion", self.elbow_flexion),
        ]
        .into_iter()
        .map(|(option, value)| (option, value.map(|value| value.to_string())))
        .chain([("intervals", self.intervals.map(|intervals| intervals.to_string()))])
        .chain([("balance", self.balance.and_then(|balance| Some(balance.to_possible_value()?.get_name().to_owned())))])
        .filter_map(|(option, value)| Some((option, value?)))
    }
}

fn drawn(table: &NominalTable, mechanism: &Mechanism) -> [(&'static str, String); 2] {
    [
        ("nominal_stick.svg", picture::nominal_stick(table, mechanism)),
        ("nominal_footprints.svg", picture::nominal_footprints(table, mechanism)),
    ]
}

/// Refuses to replace a half-step that is not the same.
fn keep_another(table: &NominalTable, out: &Path) -> Result<(), CliError> {
    let same = table.to_csv().map_err(CliError::bad_input)?;
    let Ok(existing) = fs::read(out) else { return Ok(()) };
    if existing == same.as_bytes() {
        return Ok(());
    }
    let made_by = NominalTable::read_csv(out).map_or(String::new(), |table| format!(" (made by `{}`)", table.made_by));
    Err(CliError::bad_input(format!(
        "{}: holds something else{made_by}; name another file with --out, or replace it with --force",
        out.display()
    )))
}

impl SynthesisJson {
    fn new(report: &SynthesisReport, out: PathBuf) -> Self {
        let degrees = |(min, max): (f64, f64)| [min.to_degrees(), max.to_degrees()];
        Self {
            zmp_residual_mm: report.residual * 1e3,
            iterations: report.iterations,
            trunk_pitch_deg: degrees(report.trunk_pitch),
            trunk_roll_deg: degrees(report.trunk_roll),
            knee_flexion_min_deg: report.knee_flexion_min.to_degrees(),
            swap_angle_rad: report.swap_angle,
            swap_rate_rad_per_s: report.swap_rate,
            out,
        }
    }
}

fn in_words(report: &SynthesisReport) -> String {
    let range = |(min, max): (f64, f64)| format!("{:+.2}° to {:+.2}°", min.to_degrees(), max.to_degrees());
    format!(
        "residual |ZMP−O|  {:.4} mm after {} iterations\ntrunk pitch       {}\ntrunk roll        {}\n\
         least knee bend   {:.1}°\nsupport change    {:.1e} rad and {:.1e} rad/s apart",
        report.residual * 1e3,
        report.iterations,
        range(report.trunk_pitch),
        range(report.trunk_roll),
        report.knee_flexion_min.to_degrees(),
        report.swap_angle,
        report.swap_rate,
    )
}
