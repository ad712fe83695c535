//! Goal: step extension makes steps longer or shorter and leaves the soles level; extended walking is steady.
//!
//! Method: forward kinematics from sole to sole with both mechanisms, whose ankles have their axes in opposite order.

mod common;

use std::sync::Arc;

use gait::{GaitParameters, RampKind, Start, Walk};
use interface::Command;
use model::{Joint, Mechanism};

fn extended_walk(mechanism: &Mechanism, ramp: RampKind, extension: f64) -> Walk {
    let start = Start { command: Command { extension, ..Command::NOMINAL }, ..Start::default() };
    let parameters = GaitParameters { ramp, ..common::parameters() };
    Walk::new(Arc::new(common::table(mechanism)), mechanism, &parameters, start).expect("a valid walk")
}

fn finish_half_step(walk: &mut Walk) {
    while !walk.advance(0.01) {}
}

#[test]
fn soles_are_level_throughout_extended_steps() {
    let mechanism = common::mechanism();
    for ramp in [RampKind::Linear, RampKind::Quintic] {
        for degrees in [-8.0, 5.0, 8.0_f64] {
            let mut walk = extended_walk(&mechanism, ramp, degrees.to_radians());
            for _ in 0..400 {
                let sole = common::left_sole_to_right_sole(&mechanism, &walk.motion().angles);
                assert!(common::tilt(&sole) < 1e-9, "{degrees}°: tilted by {} rad", common::tilt(&sole));
                walk.advance(0.005);
            }
        }
    }
}

/// Roll between ankle pitch and knee couples: 2.9° of it and an offset of 4° tilt the soles by 0.27° on the way.
#[test]
fn soles_tilt_by_roll_times_offset_under_the_other_reading_of_the_axes() {
    let mechanism = common::other_reading();
    let mut walk = extended_walk(&mechanism, RampKind::Quintic, 8_f64.to_radians());
    let plain = extended_walk(&mechanism, RampKind::Quintic, 0.0);
    let mut largest: f64 = 0.0;
    for _ in 0..400 {
        walk.advance(0.005);
        let of = |walk: &Walk, progress| {
            common::left_sole_to_right_sole(&mechanism, &walk.motion_at(progress).angles).rotation
        };
        let progress = walk.half_step().progress;
        largest = largest.max(of(&walk, progress).angle_to(&of(&plain, progress)));
    }
    assert!(largest < 2.0 * common::SWAY * 4_f64.to_radians(), "{}°", largest.to_degrees());
    let reach = |walk: &Walk| common::left_sole_to_right_sole(&mechanism, &walk.motion_at(1.0).angles).translation.x;
    assert!(reach(&walk) > reach(&plain) + 0.05);
}

#[test]
fn step_length_grows_with_the_extension() {
    let mechanism = common::mechanism();
    let reach = |degrees: f64| {
        let mut walk = extended_walk(&mechanism, RampKind::Quintic, degrees.to_radians());
        finish_half_step(&mut walk);
        let sole = common::left_sole_to_right_sole(&mechanism, &walk.motion_at(1.0).angles);
        // The foot that stays behind is as far behind as the other was ahead.
        let start = common::left_sole_to_right_sole(&mechanism, &walk.motion_at(0.0).angles);
        assert!((start.translation.x + sole.translation.x).abs() < 1e-9);
        sole.translation.x
    };
    // Two legs of 0.856 m, little bent, each turned by β/2 = 2.5°: 7.5 cm if they were straight and upright.
    let gained = reach(5.0) - reach(0.0);
    assert!((gained - 2.0 * 0.856 * 2.5_f64.to_radians().sin()).abs() < 0.005, "{gained}");
    assert!(reach(-5.0) < reach(0.0) - 0.06);
}

#[test]
fn the_extension_offset_runs_from_minus_half_to_plus_half_in_steady_walking() {
    let mechanism = common::mechanism();
    for ramp in [RampKind::Linear, RampKind::Quintic] {
        let extension = 6_f64.to_radians();
        let mut walk = extended_walk(&mechanism, ramp, extension);
        assert_eq!(walk.extension().per_hip(0.0).value, 0.0);
        for _ in 0..3 {
            finish_half_step(&mut walk);
            assert_eq!(walk.extension().per_hip(0.0).value, -0.5 * extension);
            assert_eq!(walk.extension().per_hip(1.0).value, 0.5 * extension);
        }
        let nominal = walk.table().at(1.0).angles;
        let end = walk.motion_at(1.0).angles - nominal;
        for (joint, sign) in [
            (Joint::RightAnklePitch, 1.0),
            (Joint::RightHipPitch, -1.0),
            (Joint::LeftHipPitch, -1.0),
            (Joint::LeftAnklePitch, 1.0),
        ] {
            assert!((end[joint] - sign * 0.5 * extension).abs() < 1e-15, "{joint:?}");
        }
    }
}
