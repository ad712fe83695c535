//! The controller's loop: wait, read, tick, write.

use controller::{Asked, Controller, Intent, Lasting, Mode, Source};
use runtime::now_ns;
use wire::{MeasurementMessage, NewestWriter, SetpointMessage};

use crate::advisor::Advisor;
use crate::exchange;
use crate::inbox::Inbox;
use crate::record::{ControllerEntry, Record};
use crate::turns::{PeerSilent, Turns};

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

/// What the loop asks by itself when it is too late too often.
const STAND: Asked = Asked {
    request: gait::Request { turn: None, speed: None, extension: None },
    intent: Some(Intent::Hold),
    source: Source::Program,
    lasting: Lasting::UntilChanged,
};

/// Runs until the turns end. After `hold_after_misses` deadlines missed in a row the robot comes to a stand; 0 is never.
///
/// # Errors
/// In lockstep the plant has been silent for too long.
pub fn run_controller(
    controller: &mut Controller,
    turns: &mut Turns<MeasurementMessage>,
    setpoints: &mut NewestWriter<SetpointMessage>,
    inbox: &mut Inbox,
    advisor: &mut Advisor,
    record: &mut Record<ControllerEntry>,
    hold_after_misses: u64,
) -> Result<ControllerRun, PeerSilent> {
    let mut run = ControllerRun::default();
    let mut asked = None;
    let mut must_stand = false;
    while let Some(turn) = turns.wait(|| inbox.collect())? {
        let time_ns = now_ns();
        run.missed += turn.missed;

        let measurement = exchange::measurement::for_controller(&turn.message);
        inbox.collect();
        advisor.serve(controller);
        must_stand |= hold_after_misses > 0 && turn.missed_in_a_row >= hold_after_misses;
        if must_stand && controller.is_free() {
            must_stand = false;
            controller.ask(&STAND);
            advisor.serve(controller);
        } else if controller.is_free()
            && let Some(due) = inbox.due(turn.tick)
        {
            controller.ask(&due.asked);
            asked = Some(due);
            advisor.serve(controller);
        }

        let report = controller.tick(turn.dt, Some(&measurement));

        setpoints.write(&exchange::setpoint::message(turn.message.tick, time_ns, &report.setpoint));
        let compute_ns = now_ns() - time_ns;

        inbox.answer(asked.take_if(|_| report.answer.is_some()), &report);
        let (late, missed) = (turn.missed > 0, run.missed);
        record.push(ControllerEntry { tick: turn.tick, time_ns, compute_ns, late, missed, report });
        let (half_steps, mode) = (report.half_step.index, Some(report.mode));
        run = ControllerRun { ticks: turn.tick + 1, missed, half_steps, mode };
    }
    Ok(run)
}
