//! Rows of a run's log, recording → log.

use balance::CentreOfMass;
use controller::AddedAngles;
use model::{PerJoint, Side};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector2, Vector3};
use record::{TickMessage, TruthMessage};
use wire::Report;

use crate::run_log::{ControllerRow, PlantRow};

/// What the controller told of a tick, at a time [s]. In the log it stands on its right foot, as within the controller.
pub fn of_controller(time: f64, tick: &TickMessage, report: &Report) -> ControllerRow {
    let sign = match report.support {
        Side::Right => 1.0,
        Side::Left => -1.0,
    };
    let point = |[x, y]: [f64; 2]| Vector2::new(x, sign * y);
    let vector = |[x, y, z]: [f64; 3]| Vector3::new(x, sign * y, z);
    let rotation = |x: f64, y: f64| Vector2::new(sign * x, y);
    let centre_of_mass = |position: Option<[f64; 3]>, velocity: Option<[f64; 3]>| {
        let (position, velocity) = position.zip(velocity)?;
        Some(CentreOfMass { position: vector(position), velocity: vector(velocity) })
    };
    ControllerRow {
        time,
        tick: tick.tick,
        mode: report.mode.text().to_owned(),
        support: report.support,
        half_step: report.half_step,
        progress: report.progress,
        speed: report.speed,
        turn_command: report.turn,
        speed_command: tick.speed_in_force,
        extension_command: report.extension,
        zmp_measured: report.zmp_in_support.map(point),
        zmp_planned: report.zmp_planned.map(point),
        margin: report.margin,
        lean_roll: sign * report.lean[0],
        lean_pitch: report.lean[1],
        added: report.added.map(|[ankle_roll, ankle_pitch, waist_roll, waist_pitch]| AddedAngles {
            ankle: rotation(ankle_roll, ankle_pitch),
            waist: rotation(waist_roll, waist_pitch),
        }),
        com_planned: centre_of_mass(report.com_planned, report.com_velocity_planned),
        com_measured: centre_of_mass(report.com_in_support, report.com_velocity_in_support),
        faults: report.faults,
        compute_ns: report.compute_ns,
        missed: report.missed.into(),
    }
}

/// What the plant was in a tick, at a time [s].
pub fn of_plant(time: f64, truth: &TruthMessage) -> PlantRow {
    let [x, y, z, qw, qx, qy, qz] = truth.right_sole;
    // It was one when it was recorded; making it one again would change its last bits.
    let rotation = UnitQuaternion::new_unchecked(Quaternion::new(qw, qx, qy, qz));
    PlantRow {
        time,
        tick: truth.tick,
        right_sole_to_world: Isometry3::from_parts(Translation3::new(x, y, z), rotation),
        angles: PerJoint(truth.angles),
        loads: truth.loads,
        com_in_world: truth.com.into(),
        zmp_in_world: Some(Vector2::from(truth.zmp)).filter(|zmp| zmp.iter().all(|value| value.is_finite())),
        trunk_tilt: truth.trunk_tilt,
        fallen: truth.fallen != 0,
    }
}
