//! The log of a run, read from its recording.

use std::path::Path;

use record::{RecordError, Recording, RunEvent, TickMessage, files_of};

use super::from_recording;
use super::rows::{ControllerRow, PlantRow};

/// The log of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunLog {
    /// Rows of the plant in order of time.
    pub plant: Vec<PlantRow>,
    /// Rows of the controller in order of time.
    pub controller: Vec<ControllerRow>,
}

impl RunLog {
    /// Reads a run: a recording, or the folder that holds it. A truncated recording is read as far as it goes, with a
    /// message on stderr.
    ///
    /// # Errors
    /// There is no recording, or it has another version.
    pub fn read(run: &Path) -> Result<Self, RecordError> {
        let mut log = Self::default();
        for file in files_of(run)? {
            let mut recording = Recording::open(&file)?;
            let mut tick = TickMessage::default();
            while let Some(stamped) = recording.next_event()? {
                match stamped.event {
                    RunEvent::Tick(message) => tick = message,
                    // The controller writes no nonsense; a tick that is lost leaves a gap that every picture bears.
                    RunEvent::Report(message) => {
                        let row = message.checked().map(|report| {
                            from_recording::of_controller(stamped.time(), &tick, &message.timing(), &report)
                        });
                        log.controller.extend(row);
                    }
                    RunEvent::Truth(message) => log.plant.push(from_recording::of_plant(stamped.time(), &message)),
                    _ => {}
                }
            }
            if let Some(cut) = recording.cut() {
                eprintln!("{cut}");
            }
        }
        Ok(log)
    }

    /// The plant's row at a time (s) or the first one after it; `None` after the end.
    pub fn plant_at(&self, time: f64) -> Option<&PlantRow> {
        self.plant.get(self.plant.partition_point(|row| row.time < time))
    }
}
