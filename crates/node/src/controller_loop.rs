//! The controller's loop: wait, read, tick, write.

use controller::{AdmissionWorker, Driver, DueRequest, RequestId};
use interface::{Fault, Intent, LatchedFault, Mode, PeriodTiming, Request, SetpointHash, Source};
use runtime::now_ns;
use wire::{LatestWriter, MeasurementMessage, RequestMessage, SetpointMessage};

use crate::cycle::{Cycles, PeerSilent};
use crate::entry::{ControllerEntry, ControllerEvent};
use crate::overload::Overload;
use crate::recorder::Recorder;
use crate::request_queue::RequestQueue;
use crate::timing::{TimingHistogram, TimingStats};

/// Result of a run of the controller's loop.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControllerRun {
    /// Control periods since the start.
    pub ticks: u64,
    /// Deadlines missed.
    pub missed: u64,
    /// Of all setpoints.
    pub setpoints: SetpointHash,
    /// Half-steps completed.
    pub half_steps: u64,
    /// The mode after the last tick; `None` if the loop never began.
    pub mode: Option<Mode>,
    /// The first fault that was latched, and when; after a reset the next one.
    pub fault: Option<LatchedFault>,
    /// When a reset cleared it: time since the first tick (s).
    pub fault_cleared: Option<f64>,
    /// Sum of the periods (s).
    time: f64,
    /// How late periods began and how long they took; in lockstep they are never late.
    pub timing: TimingStats,
}

/// The request that the loop makes by itself after too many missed deadlines in a row. Its source is its own, so that
/// it ends no operator's stream.
const HOLD: Request = Request { intent: Some(Intent::Hold), ..Request::new(Source::ControlLoop) };

/// Runs until the cycles end. When `hold_after_misses` more deadlines were missed than kept, the robot stops in stride;
/// 0 is never.
///
/// # Errors
/// In lockstep no measurement has arrived for too long.
pub fn run_controller<W: AdmissionWorker>(
    driver: &mut Driver<W>,
    cycles: &mut Cycles<MeasurementMessage>,
    setpoints: &mut LatestWriter<SetpointMessage>,
    requests: &mut RequestQueue,
    recorder: &mut Recorder<ControllerEvent>,
    hold_after_misses: u64,
) -> Result<ControllerRun, PeerSilent> {
    let mut run = ControllerRun::default();
    let mut histogram = TimingHistogram::new();
    let (mut must_hold, mut half_step) = (false, 0);
    let mut overload = Overload::new(hold_after_misses);
    while let Some(cycle) = cycles.wait(|| requests.collect(recorder))? {
        let time_ns = now_ns();
        run.missed += cycle.missed;
        must_hold |= overload.add(cycle.missed);

        requests.collect(recorder);
        requests.await_script(cycle.tick, || cycles.is_interrupted(), recorder);
        let mut submitted = None;
        let step = driver.step(cycle.dt, Some(&cycle.message.measurement()), |urgent_only| {
            submitted = if std::mem::take(&mut must_hold) {
                recorder.push(ControllerEvent::Request(RequestId::LOOP.number(), RequestMessage::from(&HOLD)));
                Some(DueRequest { id: RequestId::LOOP, request: HOLD })
            } else {
                requests.due(cycle.tick, time_ns, urgent_only, recorder)
            };
            submitted.map(|due| due.request)
        });

        let setpoint = SetpointMessage::new(cycle.message.tick, time_ns, &step.tick.setpoint);
        setpoints.write(&setpoint);
        run.setpoints.add(&step.tick.setpoint);
        let compute_ns = now_ns() - time_ns;
        histogram.add(cycle.late_ns, compute_ns);

        let mut tick = step.tick;
        if cycle.missed > 0 {
            tick.report.faults.insert(Fault::DeadlineMissed);
        }
        recorder.push(ControllerEvent::Tick(ControllerEntry {
            timing: PeriodTiming { tick: cycle.tick, time_ns, missed: run.missed, compute_ns },
            periods: cycle.periods,
            dt: cycle.dt,
            measurement: cycle.message,
            request: submitted.map_or(0, |due| due.id.number()),
            admission: step.admission,
            tick,
        }));
        requests.answer(submitted, &tick, recorder);
        run.note(tick.report.mode, tick.latched, cycle.dt);
        run.ticks = cycle.tick + 1;
        // A reset after a fall begins to count anew.
        run.half_steps += tick.report.half_step.index.saturating_sub(half_step);
        half_step = tick.report.half_step.index;
    }
    Ok(ControllerRun { timing: histogram.stats(), ..run })
}

impl ControllerRun {
    /// Whether a fault is latched.
    pub fn is_faulted(&self) -> bool {
        self.fault.is_some() && self.fault_cleared.is_none()
    }

    /// Notes mode and latched fault of a tick, which took `dt` seconds.
    fn note(&mut self, mode: Mode, latched: Option<LatchedFault>, dt: f64) {
        self.time += dt;
        self.mode = Some(mode);
        match (self.is_faulted(), latched) {
            (true, None) => self.fault_cleared = Some(self.time),
            // What follows from a latched fault is not its cause.
            (true, Some(_)) | (false, None) => {}
            (false, latched) => (self.fault, self.fault_cleared) = (latched, None),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_is_kept_until_another_one_follows_its_reset() {
        let fault = |fault, time| Some(LatchedFault { fault, time, cause: None });
        let (stale, fallen) = (fault(Fault::MeasurementStale, 0.5), fault(Fault::Fallen, 2.0));
        let mut run = ControllerRun::default();
        let told = [None, stale, fallen, None, None, fallen].map(|latched| {
            run.note(Mode::Standing, latched, 1.0);
            (run.fault, run.fault_cleared, run.is_faulted())
        });
        let cleared = (stale, Some(4.0), false);
        let expected = [(None, None, false), (stale, None, true), (stale, None, true), cleared, cleared];
        assert_eq!((&told[..5], told[5]), (&expected[..], (fallen, None, true)));
    }

    #[test]
    fn the_request_of_the_loop_itself_replays_from_its_message() {
        assert_eq!(RequestMessage::from(&HOLD).checked(), Ok(HOLD));
    }
}
