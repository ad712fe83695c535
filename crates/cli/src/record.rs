//! The record: what the loops have to tell, written down and told to observers by a thread of its own.

use std::path::Path;

use controller::TickReport;
use model::JointVector;
use plant::Truth;
use record::{Event, Note, Origin, RecordError, RecordingWriter, Returned};
use runtime::{Journal, JournalEnd, Rate};
use wire::{MeasurementMessage, ReplyMessage, ReportPublisher, RequestMessage};

use crate::exchange;
use crate::failure::Failure;
use crate::turns::Clock;

/// How many entries may wait for the thread: 4 s of the controller's.
const CAPACITY: usize = 4096;

/// What the controller's loop has to tell of one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControllerEntry {
    /// Periods since the start.
    pub tick: u64,
    /// How many periods it was for.
    pub periods: u64,
    /// Its length as the controller was told [s].
    pub dt: f64,
    /// When the period began, `CLOCK_MONOTONIC` [ns].
    pub time_ns: u64,
    /// From the measurement's arrival to the setpoint's departure [ns].
    pub compute_ns: u64,
    /// Whether deadlines were missed just before.
    pub late: bool,
    /// Deadlines missed since the start.
    pub missed: u64,
    /// What the controller went by.
    pub measurement: MeasurementMessage,
    /// The number of the request that was put to it before; 0 is none.
    pub request: u32,
    /// Whether an inquiry was given back to it before.
    pub returned: Returned,
    /// The tick itself.
    pub report: TickReport,
}

/// What the controller's process has to tell.
// A ring has room for the largest everywhere.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControllerNews {
    /// Of a tick.
    Tick(ControllerEntry),
    /// A request has come; its number counts from 1.
    Request(u32, RequestMessage),
    /// The request with that number was answered.
    Reply(u32, ReplyMessage),
}

/// What the plant's loop has to tell of one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlantEntry {
    /// Periods since the start.
    pub tick: u64,
    /// Of the physical joints [rad].
    pub angles: JointVector,
    /// What nobody on a real robot knows so well.
    pub truth: Truth,
}

/// The loop's side.
#[derive(Debug)]
pub struct Record<E: Copy + Send + 'static> {
    journal: Journal<E>,
    clock: Clock,
}

/// The other side, which writes.
#[must_use = "whether everything was written is known only after `finish`"]
pub struct RecordEnd {
    thread: JournalEnd<Pen>,
    clock: Clock,
    /// Whose.
    name: &'static str,
}

/// Where events go, if anywhere, and what became of that.
struct Pen {
    writer: Option<RecordingWriter>,
    written: Result<(), RecordError>,
    rate: Rate,
    /// Of the newest tick.
    tick: u64,
}

/// Opens the controller's record: each tick is told to observers, and all news are written to its recording if there is a
/// folder for it.
///
/// # Errors
/// The recording cannot be written or the thread not be started.
pub fn of_controller(
    clock: Clock,
    rate: Rate,
    to: Option<(&Path, Origin)>,
    mut reports: ReportPublisher,
) -> Result<(Record<ControllerNews>, RecordEnd), Failure> {
    let mut all_heard = true;
    let take = move |pen: &mut Pen, news: ControllerNews| match news {
        ControllerNews::Request(number, message) => pen.write(number, &[Event::Request(message)]),
        ControllerNews::Reply(number, message) => pen.write(number, &[Event::Reply(message)]),
        ControllerNews::Tick(entry) => {
            let message = exchange::report::message(&entry);
            if let Err(fault) = reports.publish(&message)
                && std::mem::replace(&mut all_heard, false)
            {
                tracing::warn!("observers do not hear everything: {fault}");
            }
            pen.tick = entry.tick;
            pen.write(entry.tick as u32, &exchange::tick::events(&entry, message));
        }
    };
    open(clock, rate, to.map(|(folder, origin)| (folder, record::CONTROLLER_FILE, origin)), "controller", take)
}

/// Opens the plant's record: each entry is written to its recording, if there is a folder for it.
///
/// # Errors
/// The recording cannot be written or the thread not be started.
pub fn of_plant(
    clock: Clock,
    rate: Rate,
    to: Option<(&Path, Origin)>,
) -> Result<(Record<PlantEntry>, RecordEnd), Failure> {
    let take = |pen: &mut Pen, entry: PlantEntry| {
        pen.tick = entry.tick;
        pen.write(entry.tick as u32, &[Event::Truth(exchange::truth::message(&entry))]);
    };
    open(clock, rate, to.map(|(folder, origin)| (folder, record::PLANT_FILE, origin)), "plant", take)
}

fn open<E: Copy + Send + 'static>(
    clock: Clock,
    rate: Rate,
    to: Option<(&Path, &str, Origin)>,
    name: &'static str,
    take: impl FnMut(&mut Pen, E) + Send + 'static,
) -> Result<(Record<E>, RecordEnd), Failure> {
    let create = |(folder, file, origin): (&Path, &str, Origin)| {
        std::fs::create_dir_all(folder).map_err(|error| Failure::new(format!("{}: {error}", folder.display())))?;
        // What is left of an earlier run there would be taken for a part of this one.
        let _ = std::fs::remove_file(folder.join(record::RUN_FILE));
        RecordingWriter::create(&folder.join(file), &origin).map_err(Failure::from)
    };
    let pen = Pen { writer: to.map(create).transpose()?, written: Ok(()), rate, tick: 0 };
    let (journal, thread) = Journal::open("record", CAPACITY, pen, take)
        .map_err(|error| Failure::new(format!("cannot start a thread: {error}")))?;
    Ok((Record { journal, clock }, RecordEnd { thread, clock, name }))
}

impl Pen {
    /// Writes events of the newest tick. After the first failure nothing more is written, so that there are no gaps.
    fn write(&mut self, number: u32, events: &[Event]) {
        let time_ns = (self.rate.time(self.tick) * 1e9).round() as u64;
        if let (Some(writer), Ok(())) = (&mut self.writer, &self.written) {
            self.written = events.iter().try_for_each(|event| writer.write(time_ns, number, event));
        }
    }
}

impl<E: Copy + Send + 'static> Record<E> {
    /// Tells an entry. In real time it is lost when the thread has fallen behind; lockstep has the time to wait.
    pub fn push(&mut self, entry: E) {
        while !self.journal.push(entry) && self.clock == Clock::Lockstep {
            std::thread::yield_now();
        }
    }
}

impl RecordEnd {
    /// Waits until everything is written, once the loop's side is dropped. Gives the number of entries that were lost, and
    /// notes it in the recording.
    ///
    /// # Errors
    /// Something could not be written.
    pub fn finish(self) -> Result<u64, Failure> {
        let written = self.thread.join();
        // In lockstep a full ring meant waiting, not losing.
        let lost = if self.clock == Clock::Lockstep { 0 } else { written.dropped };
        let pen = written.sink;
        pen.written?;
        if let Some(mut writer) = pen.writer {
            writer.note(&Note::new(&format!("{} end", self.name), [("lost", lost.to_string())]))?;
            writer.finish()?;
        }
        Ok(lost)
    }
}
