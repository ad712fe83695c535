//! `halfstep export`: the robot for other programs.

use std::path::PathBuf;

use clap::Subcommand;
use model::Mechanism;

use super::print_line;
use crate::configuration::Errors;
use crate::failure::{Failure, Outcome};
use crate::mjcf::mjcf_text;
use crate::python_messages::python_messages;
use crate::realtime::RealtimeParameters;
use crate::urdf::urdf_text;

/// Write the robot for other programs
#[derive(Clone, Debug, clap::Args)]
pub struct Export {
    #[command(subcommand)]
    format: Format,
}

#[derive(Clone, Debug, Subcommand)]
enum Format {
    /// As URDF, on stdout or into a file
    Urdf {
        /// The robot
        #[arg(long, value_name = "FILE", default_value = "config/mechanism.toml")]
        mechanism: PathBuf,
        /// Where to; stdout if absent
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// As MJCF, on stdout or into a file: robot, floor and torque motors, ready for MuJoCo
    Mjcf {
        /// The robot
        #[arg(long, value_name = "FILE", default_value = "config/mechanism.toml")]
        mechanism: PathBuf,
        /// Friction, slope, payload and integration step
        #[arg(long, value_name = "FILE", default_value = "config/plant.toml")]
        plant: PathBuf,
        /// How many control periods there are in a second
        #[arg(long, value_name = "FILE", default_value = "config/realtime.toml")]
        realtime: PathBuf,
        /// Where to; stdout if absent
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// The messages in shared memory as a Python module, on stdout or into a file
    Python {
        /// Where to; stdout if absent
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
}

impl Export {
    pub fn run(self) -> Result<Outcome, Failure> {
        let (text, out) = match self.format {
            Format::Urdf { mechanism, out } => {
                let mechanism = Mechanism::load(&mechanism).map_err(Failure::bad_input)?;
                (urdf_text(&mechanism).map_err(Failure::new)?, out)
            }
            Format::Mjcf { mechanism, plant, realtime, out } => {
                let mut errors = Errors::default();
                let mechanism = errors.note(Mechanism::load(&mechanism));
                let parameters = errors.note(plant::Parameters::load(&plant));
                let realtime = errors.note(RealtimeParameters::load(&realtime));
                let ((mechanism, parameters), realtime) = errors.finish(mechanism.zip(parameters).zip(realtime))?;
                (mjcf_text(&mechanism, &parameters, realtime.rate.period_s()), out)
            }
            Format::Python { out } => (python_messages(), out),
        };
        match out {
            None => print_line(text.trim_end())?,
            Some(file) => {
                std::fs::write(&file, text).map_err(|error| Failure::new(format!("{}: {error}", file.display())))?;
            }
        }
        Ok(Outcome::Fine)
    }
}
