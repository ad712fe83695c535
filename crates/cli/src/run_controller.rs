//! The controller's loop: wait, read, tick, write.

use controller::{Controller, Mode};
use record::Returned;
use runtime::now_ns;
use wire::{MeasurementMessage, NewestWriter, SetpointMessage};

use crate::advisor::Advisor;
use crate::exchange;
use crate::inbox::Inbox;
use crate::record::{ControllerEntry, ControllerNews, Record};
use crate::turns::{PERIOD, PeerSilent, Turns};

/// What there is to say at the end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControllerRun {
    /// Control periods.
    pub ticks: u64,
    /// Missed deadlines.
    pub missed: u64,
    /// Half-steps completed.
    pub half_steps: u64,
    /// What it was doing at last; `None` if it never began.
    pub mode: Option<Mode>,
}

/// Runs until the turns end.
///
/// # Errors
/// In lockstep the plant has been silent for too long.
pub fn run_controller(
    controller: &mut Controller,
    turns: &mut Turns<MeasurementMessage>,
    setpoints: &mut NewestWriter<SetpointMessage>,
    inbox: &mut Inbox,
    record: &mut Record<ControllerNews>,
) -> Result<ControllerRun, PeerSilent> {
    let mut run = ControllerRun::default();
    let mut advisor = Advisor::new(turns.clock());
    let mut asked = None;
    while let Some(turn) = turns.wait(|| inbox.collect(record))? {
        let time_ns = now_ns();
        run.missed += turn.missed;

        let measurement = exchange::measurement::for_controller(&turn.message);
        inbox.collect(record);
        let mut request = 0;
        let mut returned = if advisor.serve(controller) { Returned::BeforeRequest } else { Returned::No };
        if controller.is_free()
            && let Some(due) = inbox.due(turn.tick)
        {
            controller.ask(&due.asked);
            request = due.number;
            asked = Some(due);
            if advisor.serve(controller) {
                returned = Returned::AfterRequest;
            }
        }

        let dt = turn.periods as f64 * PERIOD.as_secs_f64();
        let report = controller.tick(dt, Some(&measurement));

        setpoints.write(&exchange::setpoint::message(turn.message.tick, time_ns, &report.setpoint));
        let compute_ns = now_ns() - time_ns;

        let (tick, periods, measurement) = (turn.tick, turn.periods, turn.message);
        let (late, missed) = (turn.missed > 0, run.missed);
        record.push(ControllerNews::Tick(ControllerEntry {
            tick,
            periods,
            dt,
            time_ns,
            compute_ns,
            late,
            missed,
            measurement,
            request,
            returned,
            report,
        }));
        inbox.answer(asked.take_if(|_| report.answer.is_some()), &report, record);
        let (half_steps, mode) = (report.half_step.index, Some(report.mode));
        run = ControllerRun { ticks: turn.tick + 1, missed, half_steps, mode };
    }
    Ok(run)
}
