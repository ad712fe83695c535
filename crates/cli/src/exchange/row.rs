//! Rows of the run's log, controller and plant → log.

use controller::Mode;
use runtime::Rate;

use crate::exchange::report::{faults, mode};
use crate::record::{ControllerEntry, PlantEntry};
use crate::run_log::{ControllerRow, PlantRow};

/// What the controller has to tell of a tick, for the log.
pub fn of_controller(entry: &ControllerEntry, rate: Rate) -> ControllerRow {
    let ControllerEntry { tick, compute_ns, late, missed, ref report, .. } = *entry;
    let is_planned = report.mode != Mode::Fallen;
    ControllerRow {
        time: rate.time(tick),
        tick,
        mode: mode(report.mode).text().to_owned(),
        support: report.half_step.support,
        half_step: report.half_step.index,
        progress: report.half_step.progress,
        speed: report.speed,
        turn_command: report.command.turn,
        speed_command: report.command.speed,
        extension_command: report.command.extension,
        zmp_measured: report.zmp_in_support,
        zmp_planned: Some(report.zmp_planned).filter(|_| is_planned),
        margin: Some(report.margin).filter(|margin| margin.is_finite()),
        lean_roll: report.lean.x,
        lean_pitch: report.lean.y,
        added: report.added,
        com_planned: Some(report.com_planned).filter(|_| is_planned),
        com_measured: report.com_sensed,
        faults: faults(report.faults, late),
        compute_ns,
        missed,
    }
}

/// What the plant has to tell of a tick, for the log.
pub fn of_plant(entry: &PlantEntry, rate: Rate) -> PlantRow {
    let PlantEntry { tick, angles, ref truth } = *entry;
    PlantRow {
        time: rate.time(tick),
        tick,
        right_sole_to_world: truth.soles[0],
        angles,
        loads: truth.loads,
        com_in_world: truth.com,
        zmp_in_world: truth.zmp,
        trunk_tilt: truth.trunk_tilt,
        fallen: truth.has_fallen(),
    }
}
