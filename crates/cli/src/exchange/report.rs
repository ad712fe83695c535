//! Report, controller → wire → observers.

use controller::{Fault, Faults, Mode};
use model::Side;
use nalgebra::{Vector2, Vector3};
use wire::ReportMessage;

use crate::record::ControllerEntry;

/// What the controller has to tell of a tick, for the wire.
pub fn message(entry: &ControllerEntry) -> ReportMessage {
    let report = &entry.report;
    // The controller stands on its right foot and mirrors the rest; on the wire everything is as it is.
    let sign = match report.half_step.support {
        Side::Right => 1.0,
        Side::Left => -1.0,
    };
    let point = |point: Vector2<f64>| [point.x, sign * point.y];
    let vector = |vector: Vector3<f64>| [vector.x, sign * vector.y, vector.z];
    let rotation = |rotation: Vector2<f64>| [sign * rotation.x, rotation.y];
    let added = report.added.map(|added| {
        let ([ankle_roll, ankle_pitch], [waist_roll, waist_pitch]) = (rotation(added.ankle), rotation(added.waist));
        [ankle_roll, ankle_pitch, waist_roll, waist_pitch]
    });
    let com_planned = Some(report.com_planned).filter(|_| report.mode != Mode::Fallen);
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
        zmp_in_support: report.zmp_in_support.map(point),
        zmp_planned: Some(point(report.zmp_planned)).filter(|_| report.mode != Mode::Fallen),
        margin: Some(report.margin).filter(|margin| margin.is_finite()),
        lean: rotation(report.lean),
        added,
        com_in_support: report.com_sensed.map(|com| vector(com.position)),
        com_velocity_in_support: report.com_sensed.map(|com| vector(com.velocity)),
        com_planned: com_planned.map(|com| vector(com.position)),
        com_velocity_planned: com_planned.map(|com| vector(com.velocity)),
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
        Mode::Standing => wire::Mode::Standing,
        Mode::Stopping => wire::Mode::Stopping,
        Mode::Faulted => wire::Mode::Faulted,
        Mode::InPlace => wire::Mode::InPlace,
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
    use balance::CentreOfMass;
    use controller::{AddedAngles, Setpoint, TickReport};
    use gait::{Command, HalfStep};

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

    #[test]
    fn on_the_left_foot_everything_is_told_as_it_is() {
        let of = |support| {
            let com = CentreOfMass { position: Vector3::new(0.1, 0.08, 0.9), velocity: Vector3::new(0.4, -0.2, 0.01) };
            let report = TickReport {
                setpoint: Setpoint::default(),
                mode: Mode::Walking,
                half_step: HalfStep::first(support),
                command: Command::NOMINAL,
                speed: 1.0,
                zmp_in_support: Some(Vector2::new(0.01, 0.02)),
                zmp_planned: Vector2::new(0.03, 0.04),
                margin: 0.02,
                lean: Vector2::new(0.1, 0.2),
                added: Some(AddedAngles { ankle: Vector2::new(0.3, 0.4), waist: Vector2::new(0.5, 0.6) }),
                com_planned: com,
                com_sensed: None,
                faults: Faults::default(),
                answer: None,
            };
            let entry = ControllerEntry {
                tick: 0,
                periods: 1,
                dt: 0.001,
                time_ns: 0,
                compute_ns: 0,
                late: false,
                missed: 0,
                measurement: <wire::MeasurementMessage as wire::Newest>::NOTHING,
                request: 0,
                returned: record::Returned::No,
                report,
            };
            message(&entry).checked().unwrap()
        };
        let (right, left) = (of(Side::Right), of(Side::Left));
        assert_eq!((right.lean, right.added), ([0.1, 0.2], Some([0.3, 0.4, 0.5, 0.6])));
        // A mirror image: points and velocities change y, rotations change x.
        assert_eq!((left.lean, left.added), ([-0.1, 0.2], Some([-0.3, 0.4, -0.5, 0.6])));
        assert_eq!((left.zmp_in_support, left.zmp_planned), (Some([0.01, -0.02]), Some([0.03, -0.04])));
        assert_eq!((left.com_planned, left.com_velocity_planned), (Some([0.1, -0.08, 0.9]), Some([0.4, 0.2, 0.01])));
        assert_eq!((left.com_in_support, left.com_velocity_in_support), (None, None));
    }
}
