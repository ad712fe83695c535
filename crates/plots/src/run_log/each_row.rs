//! The rows of a run, one after the other, as they stand in its recording.

use std::path::Path;

use model::Mechanism;
use record::{RecordError, Recording, RunEvent, TickMessage, files_of};
use wire::MeasurementMessage;

use super::estimate::Estimator;
use super::rows::{ControllerRow, PlantRow};
use super::{DriveRow, from_recording};

/// How long a measurement counts if no other one follows (s): a few periods of the slowest loop.
const STALE_AFTER: f64 = 0.02;

/// A row of the plant, of the controller, or of the drives.
// Rows are passed on one at a time: boxing the large ones would only cost time.
#[allow(clippy::large_enum_variant)]
pub(super) enum RunRow {
    Plant(PlantRow),
    Controller(ControllerRow),
    Drives(DriveRow),
}

/// Reads a run: a recording, or the folder that holds it. Returns where its files are truncated,
/// and what messages of earlier versions lack. Drives have rows only with the mechanism that tells their motors; with
/// an estimator, the plant has the rows that the controller estimates, too.
///
/// # Errors
/// There is no recording, or it has another version.
pub(super) fn each_row(
    run: &Path,
    mechanism: Option<&Mechanism>,
    estimator: Option<&Estimator<'_>>,
    mut take: impl FnMut(RunRow),
) -> Result<Vec<String>, RecordError> {
    let mut notes = Vec::new();
    for file in files_of(run)? {
        let mut recording = Recording::open(&file)?;
        let (mut tick, mut asked, mut measured) = (TickMessage::default(), None, None);
        let mut heard = None;
        while let Some(stamped) = recording.next_event()? {
            match stamped.event {
                RunEvent::Tick(message) => tick = message,
                // The controller writes no nonsense; a tick that is lost leaves a gap that every picture bears.
                RunEvent::Report(message) => {
                    if let Ok(report) = message.checked() {
                        if let Some((estimator, measured)) = estimator.zip(measured.as_ref()) {
                            take(RunRow::Plant(estimator.row(stamped.time(), tick.tick, &report, measured)));
                        }
                        let timing = message.timing();
                        let mut row = from_recording::of_controller(stamped.time(), &tick, &timing, &report);
                        // The report repeats what was measured last: of a robot that is gone, too.
                        if heard.is_some_and(|heard| row.time - heard > STALE_AFTER) {
                            (row.zmp_measured, row.margin, row.com_measured) = (None, None, None);
                        }
                        take(RunRow::Controller(row));
                    }
                }
                // It responds to the setpoint before.
                RunEvent::Measurement(message) => {
                    let is_new = measured.is_none_or(|before: MeasurementMessage| before.tick != message.tick);
                    measured = Some(message);
                    if !is_new {
                        continue;
                    }
                    heard = Some(stamped.time());
                    if let Some((mechanism, asked)) = mechanism.zip(asked.as_ref()) {
                        take(RunRow::Drives(DriveRow::new(stamped.time(), mechanism, asked, &message)));
                    }
                }
                RunEvent::Setpoint(message) => asked = Some(message),
                RunEvent::Truth(message) => take(RunRow::Plant(from_recording::of_plant(stamped.time(), &message))),
                _ => {}
            }
        }
        notes.extend(recording.cut());
        notes.extend(recording.lacking());
    }
    Ok(notes)
}
