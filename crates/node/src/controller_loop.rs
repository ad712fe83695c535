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
    /// The first fault that was latched, and when.
    pub fault: Option<LatchedFault>,
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
    let mut must_hold = false;
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
        let (half_steps, mode) = (tick.report.half_step.index, Some(tick.report.mode));
        run = ControllerRun { ticks: cycle.tick + 1, half_steps, mode, fault: run.fault.or(tick.latched), ..run };
    }
    Ok(ControllerRun { timing: histogram.stats(), ..run })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_request_of_the_loop_itself_replays_from_its_message() {
        assert_eq!(RequestMessage::from(&HOLD).checked(), Ok(HOLD));
    }
}
