//! Converts recorded events to rows of a run's log.

use interface::{PeriodTiming, Report};
use model::PerJoint;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector2};
use record::{TickMessage, TruthMessage};

use super::{ControllerRow, PlantRow};

/// The controller's report of a tick, at a time (s) since the start of the run.
pub(super) fn of_controller(time: f64, tick: &TickMessage, timing: &PeriodTiming, report: &Report) -> ControllerRow {
    ControllerRow {
        time,
        tick: tick.tick,
        mode: report.mode.text(),
        support: report.half_step.support,
        half_step: report.half_step.index,
        progress: report.half_step.progress,
        speed: report.speed,
        turn_command: report.turn,
        speed_command: tick.speed_in_force,
        extension_command: report.extension,
        sidestep_command: report.sidestep,
        zmp_measured: report.zmp_in_support,
        zmp_planned: report.zmp_planned,
        margin: report.margin,
        lean_roll: report.lean.x,
        lean_pitch: report.lean.y,
        added: report.added,
        com_planned: report.com_planned,
        com_measured: report.com_measured,
        walk_pose: report.odometry.pose,
        destination: report.destination,
        faults: report.faults.0,
        compute_ns: timing.compute_ns,
        missed: timing.missed,
    }
}

/// Converts the plant's true state at a time (s).
pub(super) fn of_plant(time: f64, truth: &TruthMessage) -> PlantRow {
    let [x, y, z, qw, qx, qy, qz] = truth.right_sole;
    // It was a unit quaternion when it was recorded; normalising it again would change its last bits.
    let rotation = UnitQuaternion::new_unchecked(Quaternion::new(qw, qx, qy, qz));
    PlantRow {
        time,
        tick: truth.tick,
        right_sole_to_world: Isometry3::from_parts(Translation3::new(x, y, z), rotation),
        angles: PerJoint(truth.angles),
        loads: truth.loads,
        com_in_world: truth.com.into(),
        com_velocity: None,
        zmp_in_world: Some(Vector2::from(truth.zmp)).filter(|zmp| zmp.iter().all(|value| value.is_finite())),
        trunk_tilt: truth.trunk_tilt,
        fallen: truth.fallen != 0,
    }
}
