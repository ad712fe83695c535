//! What the controller's loop did in a tick, loop → recording.

use record::{Event, TickMessage};
use wire::ReportMessage;

use super::setpoint;
use crate::record::ControllerEntry;

/// All that is recorded of a tick; `report` is what observers are told of it.
pub fn events(entry: &ControllerEntry, report: ReportMessage) -> [Event; 4] {
    let ControllerEntry { tick, periods, dt, time_ns, request, returned, measurement, .. } = *entry;
    let speed_in_force = entry.report.command.speed;
    [
        Event::Tick(TickMessage { tick, periods, dt, request, returned: returned as u32, speed_in_force }),
        Event::Measurement(measurement),
        Event::Setpoint(setpoint::message(measurement.tick, time_ns, &entry.report.setpoint)),
        Event::Report(report),
    ]
}
