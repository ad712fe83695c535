//! Writes recordings and publishes reports in a thread of its own, so that the loops do not have to.

use std::io::Write;
use std::path::Path;
use std::time::Duration;

use interface::{Fault, Rate};
use model::Side;
use record::{Metadata, Provenance, RecordError, RecordingWriter, RunEvent};
use runtime::{Journal, JournalEnd, now_ns};
use wire::{LatestWriter, ReportPublisher, TruePoseMessage};

use crate::announcements::{Announced, Announcements};
use crate::cycle::Clock;
use crate::entry::{ControllerEvent, PlantEvent, push_event};
use crate::error::NodeError;
use crate::tell::tell;

/// How far the thread may fall behind before entries are lost.
const LAG_MAX: Duration = Duration::from_millis(4096);

/// Takes entries from a loop. Dropping it ends the thread once everything is written.
#[derive(Debug)]
pub struct Recorder<E: Copy + Send + 'static> {
    journal: Journal<E>,
    clock: Clock,
}

/// The thread that writes a recorder's entries.
#[must_use = "whether everything was written is known only after `finish`"]
pub struct RecorderThread {
    thread: JournalEnd<RecordWriter>,
    clock: Clock,
    /// The recording process: `controller` or `plant`.
    name: &'static str,
}

/// How recording went.
#[derive(Debug)]
pub struct Recorded {
    /// Number of entries that were lost because the thread had fallen behind.
    pub lost: u64,
    /// Why the run was not recorded to its end; what was written before can be read.
    pub error: Option<NodeError>,
}

/// Writes events to the recording, if there is one, until the first error.
struct RecordWriter {
    recording: Option<RecordingWriter>,
    result: Result<(), RecordError>,
    rate: Rate,
    /// Number of the newest tick, whose time the events get.
    tick: u64,
}

/// Opens the controller's recorder. It publishes the report of each tick to observers, tells what changes and, if `to`
/// names a folder, writes all events into the controller's recording there.
///
/// # Errors
/// The recording cannot be created, or the operating system refused a thread.
pub fn of_controller(
    clock: Clock,
    rate: Rate,
    to: Option<(&Path, Provenance)>,
    mut reports: ReportPublisher,
    mut announcements: Announcements,
) -> Result<(Recorder<ControllerEvent>, RecorderThread), NodeError> {
    let mut is_first_failure = true;
    let take = move |writer: &mut RecordWriter, event: ControllerEvent| match event {
        ControllerEvent::Request(number, message) => {
            announcements.asked(number, &message);
            writer.write(number, &[RunEvent::Request(message)]);
        }
        ControllerEvent::Reply(number, message) => {
            announcements.answered(number, &message, rate.time(writer.tick)).into_iter().for_each(tell);
            writer.write(number, &[RunEvent::Reply(message)]);
        }
        ControllerEvent::Tick(entry) => {
            let mut report = entry.report();
            if writer.result.is_err() {
                report.faults |= Fault::NotRecorded.code();
            }
            if let Err(fault) = reports.publish(&report)
                && std::mem::replace(&mut is_first_failure, false)
            {
                tracing::warn!("observers do not hear everything: {fault}");
            }
            writer.tick = entry.timing.tick;
            announcements.after(&entry.tick, rate.time(entry.timing.tick)).into_iter().for_each(tell);
            writer.write(entry.timing.tick as u32, &entry.events());
        }
    };
    open(clock, rate, to.map(|(folder, origin)| (folder, record::CONTROLLER_FILE, origin)), "controller", take)
}

/// Opens the plant's recorder. It tells when the controller begins, falls silent and comes back, and when the robot
/// falls and is put on its feet, publishes where the robot truly is and, if `to` names a folder, writes each entry into
/// the plant's recording there.
///
/// # Errors
/// The recording cannot be created, or the operating system refused a thread.
pub fn of_plant(
    clock: Clock,
    rate: Rate,
    to: Option<(&Path, Provenance)>,
    announced: Announced,
    mut true_poses: LatestWriter<TruePoseMessage>,
) -> Result<(Recorder<PlantEvent>, RecorderThread), NodeError> {
    let (mut has_begun, mut is_down) = (false, false);
    let take = move |writer: &mut RecordWriter, event: PlantEvent| {
        let entry = match event {
            PlantEvent::Tick(entry) => entry,
            PlantEvent::ControllerSilent(tick) | PlantEvent::ControllerBack(tick) => {
                if announced == Announced::All {
                    let is_back = matches!(event, PlantEvent::ControllerBack(_));
                    let what = if is_back { "follows the controller again" } else { "hears the controller no more" };
                    tell(format_args!("plant: {what}, at {:.2} s", rate.time(tick)));
                }
                return;
            }
            PlantEvent::Push(tick, push) => {
                writer.tick = tick;
                return writer.write(tick as u32, &[push_event(tick, &push)]);
            }
        };
        if announced == Announced::All && entry.tick > 0 && !std::mem::replace(&mut has_begun, true) {
            tell("plant: follows the controller");
        }
        let was_down = std::mem::replace(&mut is_down, entry.truth.has_fallen());
        // Who hears of faults only learns of the fall from the controller.
        if was_down != is_down && (announced == Announced::All || was_down) {
            let what = if is_down { "has fallen" } else { "is on its feet again" };
            tell(format_args!("plant: the robot {what} at {:.2} s", rate.time(entry.tick)));
        }
        let right_sole = &entry.truth.soles[Side::Right.index()];
        true_poses.write(&TruePoseMessage::new(entry.tick, now_ns(), right_sole));
        writer.tick = entry.tick;
        writer.write(entry.tick as u32, &[entry.event()]);
    };
    open(clock, rate, to.map(|(folder, origin)| (folder, record::PLANT_FILE, origin)), "plant", take)
}

fn open<E: Copy + Send + 'static>(
    clock: Clock,
    rate: Rate,
    to: Option<(&Path, &str, Provenance)>,
    name: &'static str,
    take: impl FnMut(&mut RecordWriter, E) + Send + 'static,
) -> Result<(Recorder<E>, RecorderThread), NodeError> {
    let create = |(folder, file, origin): (&Path, &str, Provenance)| {
        std::fs::create_dir_all(folder).map_err(NodeError::file(folder))?;
        // It would be taken for a part of this run.
        record::set_aside(&folder.join(record::RUN_FILE))?;
        RecordingWriter::create(&folder.join(file), &origin).map_err(NodeError::from)
    };
    let writer = RecordWriter { recording: to.map(create).transpose()?, result: Ok(()), rate, tick: 0 };
    let (journal, thread) = Journal::open("recorder", capacity(rate), writer, take).map_err(NodeError::Thread)?;
    Ok((Recorder { journal, clock }, RecorderThread { thread, clock, name }))
}

/// Entries that may wait for the thread, with about one entry per period.
fn capacity(rate: Rate) -> usize {
    rate.ticks(LAG_MAX) as usize
}

impl RecordWriter {
    /// Writes events of the newest tick. The first failure is told at once, and after it nothing more is written, so
    /// that there are no gaps.
    fn write(&mut self, number: u32, events: &[RunEvent]) {
        let time_ns = (self.rate.time(self.tick) * 1e9).round() as u64;
        if let (Some(recording), Ok(())) = (&mut self.recording, &self.result) {
            self.result = events.iter().try_for_each(|event| recording.write(time_ns, number, event));
            if let Err(error) = &self.result {
                let time = self.rate.time(self.tick);
                // If even this cannot be written, the report's fault and the summary tell it.
                let _ = writeln!(std::io::stderr(), "from {time:.3} s on the run is not recorded: {error}");
            }
        }
    }
}

impl<E: Copy + Send + 'static> Recorder<E> {
    /// Hands an entry to the thread. When the thread has fallen behind, the entry is lost in real time; in lockstep the
    /// loop waits.
    ///
    /// A thread that has ended, which only a defect can bring about, is not waited for.
    pub fn push(&mut self, entry: E) {
        while !self.journal.push(entry) && self.clock == Clock::Lockstep && !self.journal.has_ended() {
            std::thread::yield_now();
        }
    }
}

impl RecorderThread {
    /// Waits until everything is written, which needs the [`Recorder`] to be dropped. The number of lost entries is
    /// also noted in the recording.
    pub fn finish(self) -> Recorded {
        let Some(written) = self.thread.join() else {
            let error = NodeError::Thread(std::io::Error::other("the recorder's thread has ended early"));
            return Recorded { lost: 0, error: Some(error) };
        };
        // In lockstep a full ring meant waiting, not losing.
        let lost = if self.clock == Clock::Lockstep { 0 } else { written.dropped };
        let RecordWriter { recording, result, .. } = written.sink;
        let finished = result.and_then(|()| match recording {
            None => Ok(()),
            Some(mut recording) => {
                recording
                    .write_metadata(&Metadata::new(&format!("{} end", self.name), [("lost", lost.to_string())]))?;
                recording.finish()
            }
        });
        Recorded { lost, error: finished.err().map(NodeError::from) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thread_may_fall_behind_by_four_seconds_at_any_rate() {
        let at = |hz| capacity(Rate::new(hz).expect("a rate that loops can keep"));
        assert_eq!([250, 1000, 4000].map(at), [1024, 4096, 16384]);
    }
}
