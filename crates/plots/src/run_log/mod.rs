//! The log of a run, from which pictures and summaries are made: true state of the plant and report of the controller
//! over time, read from a recording.
//!
//! It can be written as CSV files for spreadsheets, whose first line has the names of the columns with units. Commanded
//! angles are in degrees there, joint angles in radians as in the nominal table.

mod columns;
mod csv_file;
mod drive_account;
mod drive_row;
mod each_row;
mod end_pose;
mod estimate;
mod fall;
mod footprint;
mod from_recording;
mod least_margin;
mod log;
mod measures;
mod part;
mod plausible;
mod rows;
mod run_totals;
mod support;
#[cfg(test)]
pub(crate) mod synthetic;
mod thinner;
mod window;
mod zmp_error;

pub use csv_file::{CsvError, write_csv};
pub use drive_account::{CostOfTransport, DriveEnergy, JointLoad};
pub use drive_row::DriveRow;
pub use end_pose::EndPose;
pub use fall::Fall;
pub use footprint::FootPlacement;
pub use least_margin::LeastMargin;
pub use log::RunLog;
pub use measures::Measures;
pub use rows::{ControllerRow, CsvRow, PlantRow};
pub use run_totals::{FaultedSince, RunTotals};
pub use window::TimeWindow;
