//! Report, controller → wire → observers.

use controller::{Fault, Faults, Mode};
use model::Side;
use nalgebra::Vector2;
use wire::ReportMessage;

use crate::record::ControllerEntry;

/// What the controller has to tell of a tick, for the wire.
pub fn message(entry: &ControllerEntry) -> ReportMessage {
    let report = &entry.report;
    // The controller stands on its right foot and mirrors the rest; on the wire everything is as it is.
    let across = |point: Vector2<f64>| match report.half_step.support {
        Side::Right => [point.x, point.y],
        Side::Left => [point.x, -point.y],
    };
    ReportMessage::from(&wire::Report {
        tick: entry.tick,
        time_ns: entry.time_ns,
        mode: mode(report.mode),
        support: report.half_step.support,
        half_step: report.half_step.index,
        progress: report.half_step.progress,
        speed: report.speed,
        turn: report.command.turn,
        extension: report.command.extension,
        zmp_in_support: report.zmp_in_support.map(across),
        zmp_planned: Some(across(report.zmp_planned)),
        margin: Some(report.margin).filter(|margin| margin.is_finite()),
        lean: report.lean.into(),
        faults: faults(report.faults, entry.late),
        missed: u32::try_from(entry.missed).unwrap_or(u32::MAX),
        compute_ns: entry.compute_ns,
    })
}

/// The mode's name on the wire.
pub fn mode(mode: Mode) -> wire::Mode {
    match mode {
        Mode::Walking => wire::Mode::Walking,
        Mode::Holding => wire::Mode::Holding,
        Mode::Fallen => wire::Mode::Fallen,
        Mode::Starting => wire::Mode::Starting,
    }
}

/// The faults' bits on the wire; `late` when a deadline was missed.
pub fn faults(faults: Faults, late: bool) -> u32 {
    let late = late.then_some(wire::Fault::DeadlineMissed);
    wire::Fault::sum(faults.iter().map(fault).chain(late))
}

fn fault(fault: Fault) -> wire::Fault {
    match fault {
        Fault::MeasurementStale => wire::Fault::MeasurementStale,
        Fault::MeasurementNotFinite => wire::Fault::MeasurementNotFinite,
        Fault::MeasurementAbsurd => wire::Fault::MeasurementAbsurd,
        Fault::MeasurementOutOfOrder => wire::Fault::MeasurementOutOfOrder,
        Fault::AngleLimited => wire::Fault::AngleLimited,
        Fault::RateLimited => wire::Fault::RateLimited,
        Fault::WalkNotFinite => wire::Fault::SetpointNotFinite,
        Fault::OutOfReach => wire::Fault::OutOfReach,
        Fault::InTheAir => wire::Fault::InTheAir,
        Fault::Fallen => wire::Fault::Fallen,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_keep_apart() {
        let all = Fault::ALL.into_iter().fold(Faults::default(), |mut all, fault| {
            all.insert(fault);
            all
        });
        // A missed deadline is added.
        assert_eq!(faults(all, true).count_ones() as usize, Fault::ALL.len() + 1);
        assert_eq!(faults(Faults::default(), false), 0);
    }
}
