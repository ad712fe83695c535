//! The log of a run, as pictures and the summary are made from it: what the plant was and what the controller said at every
//! tick, read from a recording.
//!
//! As CSV files, for spreadsheets, it begins with a line of column names that carry units; angles that people command are in
//! degrees there, joint angles in radians as in the nominal table.

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

use ::record::{Event, RecordError, Recording, TickMessage, files_of};

use crate::exchange;

pub use fall::Fall;
pub use file::write_rows;
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
    /// Reads a run: a recording, or the folder that holds it. What was cut off is said on stderr, and the rest is read.
    ///
    /// # Errors
    /// There is no recording, or one of another version.
    pub fn read(run: &Path) -> Result<Self, RecordError> {
        let mut log = Self::default();
        for file in files_of(run)? {
            let mut recording = Recording::open(&file)?;
            let mut tick = TickMessage::default();
            while let Some(stamped) = recording.next_event()? {
                match stamped.event {
                    Event::Tick(message) => tick = message,
                    // The controller writes no nonsense; a tick that is lost leaves a gap that every picture bears.
                    Event::Report(message) => {
                        let row = message
                            .checked()
                            .map(|report| exchange::row::of_controller(stamped.time(), &tick, &report));
                        log.controller.extend(row);
                    }
                    Event::Truth(message) => log.plant.push(exchange::row::of_plant(stamped.time(), &message)),
                    _ => {}
                }
            }
            if let Some(cut) = recording.cut() {
                eprintln!("{cut}");
            }
        }
        Ok(log)
    }

    /// The plant at a time [s] or at the first tick after it; `None` after the end.
    pub fn plant_at(&self, time: f64) -> Option<&PlantRow> {
        self.plant.get(self.plant.partition_point(|row| row.time < time))
    }
}
