//! The log of a run, from which pictures and summaries are made: true state of the plant and report of the controller
//! over time, read from a recording.
//!
//! It can be written as CSV files for spreadsheets, whose first line has the names of the columns with units. Commanded
//! angles are in degrees there, joint angles in radians as in the nominal table.

mod columns;
mod csv_file;
mod each_row;
mod end_pose;
mod fall;
mod footprint;
mod from_recording;
mod log;
mod measures;
mod plausible;
mod rows;
mod support;
#[cfg(test)]
pub(crate) mod synthetic;
mod thinner;

pub use csv_file::{CsvError, write_csv};
pub use end_pose::EndPose;
pub use fall::Fall;
pub use footprint::FootPlacement;
pub use log::RunLog;
pub use measures::Measures;
pub use rows::{ControllerRow, CsvRow, PlantRow};
