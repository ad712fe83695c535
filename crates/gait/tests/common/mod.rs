//! A robot, a synthetic half-step for it, and forward kinematics from sole to sole.
//!
//! The half-step is made of functions that repeat after two half-steps, each leg half a period behind the other: so its
//! end mirrors its start in angle, rate and acceleration, and soles and pelvis stay level (pitch and roll each add up
//! to zero from the ground to the pelvis and down again).

#![allow(dead_code, reason = "each test uses its part of it")]

use std::f64::consts::PI;
use std::sync::Arc;
use std::time::Duration;

use config::Config;
use gait::{GaitParameters, Limits, NominalRow, NominalTable, RampKind, Start, Walk};
use interface::{Command, GaitChange};
use model::{Joint, JointVector, Mechanism, Mirror, Motion, PerJoint, Side, Wrench};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

/// `T` (s).
pub(crate) const DURATION: f64 = 0.6;
/// Largest roll of the support leg in the synthetic half-step (rad).
pub(crate) const SWAY: f64 = 0.05;

/// The gait parameters of these tests: quintic ramps, changes of speed over one half-step, the range of the paper's
/// figures. The committed ones are wider; no statement here depends on them.
pub(crate) fn parameters() -> GaitParameters {
    let limits = Limits {
        turn_max: 30_f64.to_radians(),
        speed_min: 0.6,
        speed_max: 1.4,
        extension_min: -8_f64.to_radians(),
        extension_max: 8_f64.to_radians(),
        sidestep_max: 15_f64.to_radians(),
    };
    GaitParameters { ramp: RampKind::Quintic, speed_ramp: Duration::from_millis(600), limits }
}

/// The robot of `config/mechanism.toml`.
pub(crate) fn mechanism() -> Mechanism {
    Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).expect("the committed file")
}

/// The same body with roll and pitch of ankles and waist exchanged.
pub(crate) fn other_reading() -> Mechanism {
    Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism_other_reading.toml"))
        .expect("the committed file")
}

/// The synthetic half-step with 24 intervals.
pub(crate) fn table(mechanism: &Mechanism) -> NominalTable {
    let rows = (0..=24).map(|row| nominal_row(mechanism, DURATION * f64::from(row) / 24.0)).collect();
    NominalTable { duration: DURATION, rows, made_by: "a test's sines".into(), mechanism: mechanism.body_fingerprint }
}

/// A walk from the synthetic half-step.
pub(crate) fn walk(parameters: &GaitParameters, support: Side, command: Command) -> Walk {
    let mechanism = mechanism();
    let table = Arc::new(table(&mechanism));
    Walk::new(table, &mechanism, parameters, Start { support, command }).expect("a valid walk")
}

/// The row of the table at `t` (s).
fn nominal_row(mechanism: &Mechanism, t: f64) -> NominalRow {
    let h = 1e-4;
    let (before, here, after) = (angles(mechanism, t - h), angles(mechanism, t), angles(mechanism, t + h));
    // Central differences with their next term: exact to about 1e-11, far below what the tests look at.
    let (before2, after2) = (angles(mechanism, t - 2.0 * h), angles(mechanism, t + 2.0 * h));
    let rates = ((after - before) * 8.0 - (after2 - before2)) * (1.0 / (12.0 * h));
    let accelerations = ((after + before) * 16.0 - (after2 + before2) - here * 30.0) * (1.0 / (12.0 * h * h));
    let wrench = |scale: f64| Wrench {
        force: Vector3::new(3.0, -0.1, 700.0 + t) * scale,
        moment: Vector3::new(t / 3.0, 1.0, -2e-7) * scale,
    };
    NominalRow {
        motion: Motion { angles: here, rates, accelerations },
        torque_gravity: here * (100.0 / 3.0),
        torque_dynamic: accelerations * 0.7,
        ground_gravity: wrench(1.0),
        ground_dynamic: wrench(0.01 * (t - 0.3)),
    }
}

fn angles(mechanism: &Mechanism, t: f64) -> JointVector {
    use Joint::*;
    let mirror = Mirror::new(mechanism).expect("a symmetric robot");
    let phase = |t: f64| PI * t / DURATION;
    // The right leg supports the robot from 0 to T and swings from T to 2T.
    let right = |t: f64| {
        let ankle = -0.2 * phase(t).cos();
        let knee = -0.35 + 0.25 * phase(t).sin();
        let roll = SWAY * phase(t).sin();
        [
            (pitch_of(mechanism, RightAnklePitch, RightAnkleRoll), ankle),
            (RightKnee, knee),
            (RightHipPitch, -ankle - knee),
            (roll_of(mechanism, RightAnklePitch, RightAnkleRoll), roll),
            (RightHipRoll, -roll),
            (RightShoulder, 0.3 * phase(t).cos()),
            (RightElbow, -0.4),
        ]
    };
    let mut angles = JointVector::ZERO;
    for (joint, angle) in right(t) {
        angles[joint] = angle;
    }
    for (joint, angle) in right(t + DURATION) {
        let left = mirror.partner(joint);
        angles[left] = mirror.sign(left) * angle;
    }
    angles[pitch_of(mechanism, WaistPitch, WaistRoll)] = -0.2 + 0.02 * (2.0 * phase(t)).cos();
    angles[roll_of(mechanism, WaistPitch, WaistRoll)] = 0.01 * phase(t).cos();
    angles
}

fn pitch_of(mechanism: &Mechanism, one: Joint, other: Joint) -> Joint {
    if mechanism.links[one].axis.y == 1.0 { one } else { other }
}

fn roll_of(mechanism: &Mechanism, one: Joint, other: Joint) -> Joint {
    if mechanism.links[one].axis.x == 1.0 { one } else { other }
}

/// The left sole in the frame of the right sole, which is the support frame when the foot is flat.
pub(crate) fn left_sole_to_right_sole(mechanism: &Mechanism, angles: &JointVector) -> Isometry3<f64> {
    let mut link_to_support = PerJoint([Isometry3::identity(); Joint::COUNT]);
    for joint in Joint::ALL {
        let link = &mechanism.links[joint];
        let parent = link.parent.map_or(Isometry3::identity(), |parent| link_to_support[parent]);
        let turned = UnitQuaternion::from_axis_angle(&link.axis, angles[joint]);
        link_to_support[joint] = parent * Isometry3::from_parts(Translation3::from(link.origin), turned);
    }
    let sole = |side| link_to_support[mechanism.foot(side)] * Translation3::from(mechanism.sole_in_foot(side));
    sole(Side::Right).inverse() * sole(Side::Left)
}

/// Angle between a sole's normal and the vertical (rad).
pub(crate) fn tilt(sole: &Isometry3<f64>) -> f64 {
    let normal = sole.rotation * Vector3::z();
    normal.xy().norm().atan2(normal.z)
}

/// Which way a sole points, from x to y (rad).
pub(crate) fn heading(sole: &Isometry3<f64>) -> f64 {
    let forward = sole.rotation * Vector3::x();
    forward.y.atan2(forward.x)
}

/// Requests as an operator might send them, at random times (ticks until the next); some outside the limits, some not
/// even numbers.
pub(crate) fn streams() -> impl Strategy<Value = Vec<(u32, GaitChange)>> {
    prop::collection::vec((1_u32..900, requests()), 1..12)
}

fn requests() -> impl Strategy<Value = GaitChange> {
    let value = |range: std::ops::Range<f64>| {
        prop_oneof![
            8 => range.prop_map(Some),
            4 => Just(None),
            1 => Just(Some(f64::NAN)),
            1 => Just(Some(0.0)),
        ]
    };
    let values = (value(-0.7..0.7), value(0.4..1.6), value(-0.2..0.2), value(-0.4..0.4));
    values.prop_map(|(turn, speed, extension, sidestep)| GaitChange { turn, speed, extension, sidestep })
}
