//! The controller's loop: wait, read, tick, write.

use controller::{Asked, Controller, Intent, Lasting, Mode, Source};
use record::Returned;
use runtime::now_ns;
use wire::{MeasurementMessage, NewestWriter, Request, RequestMessage, SetpointMessage};

use crate::advisor::Advisor;
use crate::clerk::LetterId;
use crate::exchange;
use crate::inbox::Inbox;
use crate::loop_times::{KeptTime, LoopTimes};
use crate::record::{ControllerEntry, ControllerNews, Record};
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
    /// How late periods began and what they took; in lockstep they are never late.
    pub kept_time: KeptTime,
}

/// What the loop asks by itself when it is too late too often.
const STAND: Asked = Asked {
    request: gait::Request { turn: None, speed: None, extension: None },
    intent: Some(Intent::Hold),
    source: Source::Program,
    lasting: Lasting::UntilChanged,
};

/// [`STAND`] as an operator would write it, for the recording.
fn stand_message() -> RequestMessage {
    (&Request { intent: Some(wire::Intent::Hold), ..Request::by(wire::Source::Program) }).into()
}

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
    record: &mut Record<ControllerNews>,
    hold_after_misses: u64,
) -> Result<ControllerRun, PeerSilent> {
    let mut run = ControllerRun::default();
    let mut times = LoopTimes::new();
    let mut asked = None;
    let mut must_stand = false;
    while let Some(turn) = turns.wait(|| inbox.collect(record))? {
        let time_ns = now_ns();
        run.missed += turn.missed;

        let measurement = exchange::measurement::for_controller(&turn.message);
        inbox.collect(record);
        let mut returned = if advisor.serve(controller) { Returned::BeforeRequest } else { Returned::No };
        must_stand |= hold_after_misses > 0 && turn.missed_in_a_row >= hold_after_misses;
        let wanted = if !controller.is_free() {
            None
        } else if std::mem::take(&mut must_stand) {
            record.push(ControllerNews::Request(LetterId::LOOP.number(), stand_message()));
            Some((LetterId::LOOP, STAND))
        } else {
            asked = inbox.due(turn.tick);
            asked.as_ref().map(|due| (due.id, due.asked))
        };
        if let Some((_, wanted)) = &wanted {
            controller.ask(wanted);
            if advisor.serve(controller) {
                returned = Returned::AfterRequest;
            }
        }

        let report = controller.tick(turn.dt, Some(&measurement));

        setpoints.write(&exchange::setpoint::message(turn.message.tick, time_ns, &report.setpoint));
        let compute_ns = now_ns() - time_ns;
        times.add(turn.late_ns, compute_ns);

        let (tick, periods, dt, measurement) = (turn.tick, turn.periods, turn.dt, turn.message);
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
            request: wanted.map_or(0, |(id, _)| id.number()),
            returned,
            report,
        }));
        inbox.answer(asked.take_if(|_| report.answer.is_some()), &report, record);
        let (half_steps, mode) = (report.half_step.index, Some(report.mode));
        run = ControllerRun { ticks: turn.tick + 1, missed, half_steps, mode, ..run };
    }
    Ok(ControllerRun { kept_time: times.kept(), ..run })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_loop_asks_is_recorded_as_it_is() {
        assert_eq!(exchange::request::for_controller(&stand_message()), Ok((0, STAND)));
    }
}
