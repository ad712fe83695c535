//! The record: what the loops have to tell, written down and told to observers by a thread of its own.

use std::path::Path;

use controller::TickReport;
use model::JointVector;
use plant::Truth;
use runtime::{Journal, JournalEnd};
use wire::ReportPublisher;

use crate::exchange;
use crate::failure::Failure;
use crate::run_log::{ControllerRow, PlantRow, Row, RowWriter, RunLogError};
use crate::turns::Clock;
use runtime::Rate;

/// How many entries may wait for the thread: 4 s of the controller's.
const CAPACITY: usize = 4096;

/// What the controller's loop has to tell of one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControllerEntry {
    /// Periods since the start.
    pub tick: u64,
    /// When the period began, `CLOCK_MONOTONIC` [ns].
    pub time_ns: u64,
    /// From the measurement's arrival to the setpoint's departure [ns].
    pub compute_ns: u64,
    /// Whether deadlines were missed just before.
    pub late: bool,
    /// Deadlines missed since the start.
    pub missed: u64,
    /// The tick itself.
    pub report: TickReport,
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

/// The other side, which writes rows `R`.
#[must_use = "whether everything was written is known only after `finish`"]
pub struct RecordEnd<R> {
    thread: JournalEnd<Rows<R>>,
    clock: Clock,
}

/// Where rows go, if anywhere, and what became of that.
struct Rows<R> {
    writer: Option<RowWriter<R>>,
    written: Result<(), RunLogError>,
}

/// Opens the controller's record: each entry is told to observers and, if there is a folder, written to its log there.
///
/// # Errors
/// The log cannot be written or the thread not be started.
pub fn of_controller(
    clock: Clock,
    rate: Rate,
    folder: Option<&Path>,
    mut reports: ReportPublisher,
) -> Result<(Record<ControllerEntry>, RecordEnd<ControllerRow>), Failure> {
    let mut all_heard = true;
    open(clock, folder, move |entry: &ControllerEntry| {
        if let Err(fault) = reports.publish(&exchange::report::message(entry))
            && std::mem::replace(&mut all_heard, false)
        {
            tracing::warn!("observers do not hear everything: {fault}");
        }
        exchange::row::of_controller(entry, rate)
    })
}

/// Opens the plant's record: each entry is written to its log, if there is a folder.
///
/// # Errors
/// The log cannot be written or the thread not be started.
pub fn of_plant(
    clock: Clock,
    rate: Rate,
    folder: Option<&Path>,
) -> Result<(Record<PlantEntry>, RecordEnd<PlantRow>), Failure> {
    open(clock, folder, move |entry| exchange::row::of_plant(entry, rate))
}

fn open<E: Copy + Send + 'static, R: Row + Send + 'static>(
    clock: Clock,
    folder: Option<&Path>,
    mut row: impl FnMut(&E) -> R + Send + 'static,
) -> Result<(Record<E>, RecordEnd<R>), Failure> {
    let create = |folder: &Path| {
        std::fs::create_dir_all(folder).map_err(|error| Failure::new(format!("{}: {error}", folder.display())))?;
        RowWriter::create(folder).map_err(Failure::from)
    };
    let rows = Rows { writer: folder.map(create).transpose()?, written: Ok(()) };
    let take = move |rows: &mut Rows<R>, entry: E| {
        let row = row(&entry);
        // After the first failure nothing more is written, so that the log has no gaps.
        if let (Some(writer), Ok(())) = (&mut rows.writer, &rows.written) {
            rows.written = writer.write(&row);
        }
    };
    let (journal, thread) = Journal::open("record", CAPACITY, rows, take)
        .map_err(|error| Failure::new(format!("cannot start a thread: {error}")))?;
    Ok((Record { journal, clock }, RecordEnd { thread, clock }))
}

impl<E: Copy + Send + 'static> Record<E> {
    /// Tells an entry. In real time it is lost when the thread has fallen behind; lockstep has the time to wait.
    pub fn push(&mut self, entry: E) {
        while !self.journal.push(entry) && self.clock == Clock::Lockstep {
            std::thread::yield_now();
        }
    }
}

impl<R: Row> RecordEnd<R> {
    /// Waits until everything is written, once the loop's side is dropped. Gives the number of entries that were lost.
    ///
    /// # Errors
    /// Something could not be written.
    pub fn finish(self) -> Result<u64, Failure> {
        let rows = self.thread.join();
        let Rows { writer, written } = rows.sink;
        written?;
        writer.map_or(Ok(()), |mut writer| writer.flush())?;
        // In lockstep a full ring meant waiting, not losing.
        Ok(if self.clock == Clock::Lockstep { 0 } else { rows.dropped })
    }
}
