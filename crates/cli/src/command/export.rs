//! `halfstep export`: the robot for other programs.

use std::path::PathBuf;

use clap::Subcommand;
use model::Mechanism;

use super::print_line;
use crate::failure::{Failure, Outcome};
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
}

impl Export {
    pub fn run(self) -> Result<Outcome, Failure> {
        let Format::Urdf { mechanism, out } = self.format;
        let mechanism = Mechanism::load(&mechanism).map_err(Failure::bad_input)?;
        let text = urdf_text(&mechanism).map_err(Failure::new)?;
        match out {
            None => print_line(text.trim_end())?,
            Some(file) => {
                std::fs::write(&file, text).map_err(|error| Failure::new(format!("{}: {error}", file.display())))?;
            }
        }
        Ok(Outcome::Fine)
    }
}
