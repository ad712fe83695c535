//! The log of a run: what the plant was and what the controller said at every tick, as two CSV files in one folder.
//!
//! Both begin with a line of column names that carry units; angles that people command are in degrees there, joint
//! angles in radians as in the nominal table. Pictures and the summary are made from the log alone, so that they can be
//! made again at any time.

mod columns;
mod fall;
mod file;
mod footprint;
mod measures;
mod rows;
mod support;
#[cfg(test)]
pub(crate) mod synthetic;

use std::path::Path;

pub use fall::Fall;
pub use file::{RowWriter, RunLogError, read_rows};
pub use footprint::Footprint;
pub use measures::Measures;
pub use rows::{ControllerRow, PlantRow, Row};

/// A run, read back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunLog {
    /// The plant at each of its ticks, in order of time.
    pub plant: Vec<PlantRow>,
    /// The controller at each of its ticks, in order of time.
    pub controller: Vec<ControllerRow>,
}

impl RunLog {
    /// Reads both files of the folder `dir`. A last line that a crash cut off is an error like any other.
    ///
    /// # Errors
    /// See [`RunLogError`]: it names the file and the line.
    pub fn read(dir: &Path) -> Result<Self, RunLogError> {
        Ok(Self { plant: read_rows(dir)?, controller: read_rows(dir)? })
    }

    /// The plant at a time [s] or at the first tick after it; `None` after the end.
    pub fn plant_at(&self, time: f64) -> Option<&PlantRow> {
        self.plant.get(self.plant.partition_point(|row| row.time < time))
    }
}
