//! The rows of a run, one after the other, as they stand in its recording.

use std::path::Path;

use record::{RecordError, Recording, RunEvent, TickMessage, files_of};

use super::from_recording;
use super::rows::{ControllerRow, PlantRow};

/// A row of the plant or of the controller.
pub(super) enum RunRow {
    Plant(PlantRow),
    Controller(ControllerRow),
}

/// Reads a run: a recording, or the folder that holds it. Returns where its files are truncated,
/// and what messages of earlier versions lack.
///
/// # Errors
/// There is no recording, or it has another version.
pub(super) fn each_row(run: &Path, mut take: impl FnMut(RunRow)) -> Result<Vec<String>, RecordError> {
    let mut notes = Vec::new();
    for file in files_of(run)? {
        let mut recording = Recording::open(&file)?;
        let mut tick = TickMessage::default();
        while let Some(stamped) = recording.next_event()? {
            match stamped.event {
                RunEvent::Tick(message) => tick = message,
                // The controller writes no nonsense; a tick that is lost leaves a gap that every picture bears.
                RunEvent::Report(message) => {
                    if let Ok(report) = message.checked() {
                        let timing = message.timing();
                        take(RunRow::Controller(from_recording::of_controller(
                            stamped.time(),
                            &tick,
                            &timing,
                            &report,
                        )));
                    }
                }
                RunEvent::Truth(message) => take(RunRow::Plant(from_recording::of_plant(stamped.time(), &message))),
                _ => {}
            }
        }
        notes.extend(recording.cut());
        notes.extend(recording.lacking());
    }
    Ok(notes)
}
