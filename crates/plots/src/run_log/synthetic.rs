//! For tests: the log of a robot whose joints do not move while its soles go along a line or a circle.

use config::Config;
use interface::{Setpoint, WalkPose};
use model::{Joint, JointVector, Mechanism, Side};
use nalgebra::{Isometry3, Vector2, Vector3};
use wire::{MeasurementMessage, SetpointMessage, WireLayout};

use super::{ControllerRow, DriveRow, PlantRow, RunLog};

/// Ticks per half-step; a tick takes 0.1 s.
const TICKS: u64 = 6;

pub(crate) fn mechanism() -> Mechanism {
    Mechanism::load(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR"))).expect("the committed file")
}

/// A log of `half_steps` completed half-steps and the beginning of another; in each the robot stands 0.25 m farther and
/// turned by `turn` (rad).
pub(crate) fn log(half_steps: u64, turn: f64) -> RunLog {
    let mut log = RunLog::default();
    let mut right_sole_to_world = Isometry3::identity();
    for tick in 0..half_steps * TICKS + TICKS / 2 {
        let (half_step, time) = (tick / TICKS, tick as f64 * 0.1);
        if tick > 0 && tick % TICKS == 0 {
            right_sole_to_world *= Isometry3::new(Vector3::x() * 0.25, Vector3::z() * turn);
        }
        let support = Side::BOTH[(half_step % 2) as usize];
        let loads = if support == Side::Right { [700.0, 0.0] } else { [0.0, 700.0] };
        log.plant.push(PlantRow {
            time,
            tick,
            right_sole_to_world,
            angles: JointVector::ZERO,
            loads,
            com_in_world: Vector3::new(1.0, 2.0, 0.9),
            com_velocity: None,
            zmp_in_world: Some(right_sole_to_world.translation.vector.xy()),
            trunk_tilt: 0.1,
            fallen: false,
        });
        log.controller.push(ControllerRow {
            time,
            tick,
            mode: "walking",
            support,
            half_step,
            progress: (tick % TICKS) as f64 / TICKS as f64,
            speed: 1.0,
            turn_command: 0.0,
            speed_command: 1.0,
            extension_command: 0.0,
            sidestep_command: 0.0,
            zmp_measured: Some(Vector2::new(0.01, -0.02)),
            zmp_planned: None,
            margin: Some(0.02),
            lean_roll: 0.0,
            lean_pitch: 0.0,
            added: None,
            com_planned: None,
            com_measured: None,
            walk_pose: WalkPose::default(),
            destination: None,
            faults: 0,
            compute_ns: 1234,
            missed: 0,
        });
    }
    log.controller.iter().for_each(|row| log.totals.note_controller(row));
    log
}

/// A measurement in which all motors have a current (A), and all else is zero.
pub(crate) fn measurement(current: f64) -> MeasurementMessage {
    let mut measurement = MeasurementMessage::decode(&vec![0; MeasurementMessage::layout().size]).expect("zeros");
    measurement.motor_current = [current; Joint::COUNT];
    measurement
}

/// The drives at a time (s), asked for nothing, with a current (A) each.
pub(crate) fn drives_at(time: f64, mechanism: &Mechanism, current: impl Fn(Joint) -> f64) -> DriveRow {
    let mut measured = measurement(0.0);
    measured.motor_current = Joint::ALL.map(current);
    DriveRow::new(time, mechanism, &SetpointMessage::new(0, 0, &Setpoint::default()), &measured)
}
