//! The worker that evaluates admission jobs: in the loop itself in lockstep, so that a run depends on nothing but its
//! inputs; on a thread beside the loop in real time, so that no tick waits for it.

use std::thread::JoinHandle;

use controller::{AdmissionJob, AdmissionTiming, AdmissionWorker, Controller, InlineWorker};
use crossbeam::channel::{Receiver, Sender, bounded};
use runtime::Scheduling;

use crate::cycle::Clock;
use crate::error::NodeError;

/// Evaluates admission jobs by the clock of the process.
pub enum ClockedWorker {
    /// In lockstep: the loop itself evaluates them.
    Inline(InlineWorker),
    /// In real time: a thread beside the loop evaluates them.
    Threaded(AdmissionThread),
}

/// A thread that evaluates one admission job after the other.
pub struct AdmissionThread {
    /// Jobs to evaluate; `None` once the thread is to end.
    jobs: Option<Sender<Box<AdmissionJob>>>,
    /// Evaluated jobs.
    evaluated: Receiver<Box<AdmissionJob>>,
    /// Ends when `jobs` is dropped.
    thread: Option<JoinHandle<()>>,
}

impl ClockedWorker {
    /// A worker for a clock. A thread asks the system for `scheduling` and runs on with whatever it is granted.
    ///
    /// # Errors
    /// The operating system refused another thread.
    pub fn new(clock: Clock, scheduling: Scheduling) -> Result<Self, NodeError> {
        match clock {
            Clock::Lockstep => Ok(ClockedWorker::Inline(InlineWorker)),
            Clock::Realtime => AdmissionThread::start(scheduling).map(ClockedWorker::Threaded),
        }
    }
}

impl AdmissionWorker for ClockedWorker {
    fn serve(&mut self, controller: &mut Controller, point: AdmissionTiming) -> bool {
        match self {
            ClockedWorker::Inline(worker) => worker.serve(controller, point),
            ClockedWorker::Threaded(worker) => worker.serve(controller, point),
        }
    }
}

impl AdmissionThread {
    fn start(scheduling: Scheduling) -> Result<Self, NodeError> {
        let (jobs, incoming) = bounded::<Box<AdmissionJob>>(1);
        let (outgoing, evaluated) = bounded(1);
        let thread = std::thread::Builder::new()
            .name("admission".to_owned())
            .spawn(move || {
                let _died = TellDeath;
                let _granted = scheduling.request();
                for mut job in incoming {
                    job.evaluate();
                    if outgoing.send(job).is_err() {
                        break;
                    }
                }
            })
            .map_err(NodeError::Thread)?;
        Ok(Self { jobs: Some(jobs), evaluated, thread: Some(thread) })
    }
}

/// Tells when the thread ends by a panic.
struct TellDeath;

impl Drop for TellDeath {
    fn drop(&mut self) {
        if std::thread::panicking() {
            tracing::error!(
                "the thread that evaluates requests has died: only stop and hold are answered; restart the controller"
            );
        }
    }
}

/// It never waits for the thread.
impl AdmissionWorker for AdmissionThread {
    fn serve(&mut self, controller: &mut Controller, _: AdmissionTiming) -> bool {
        let is_completed = self.evaluated.try_recv().map(|job| controller.complete(job)).is_ok();
        // There is one job at most, so there is room for it.
        if let (Some(jobs), Some(job)) = (&self.jobs, controller.take_job()) {
            let _ = jobs.try_send(job);
        }
        is_completed
    }
}

impl Drop for AdmissionThread {
    fn drop(&mut self) {
        self.jobs.take();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
