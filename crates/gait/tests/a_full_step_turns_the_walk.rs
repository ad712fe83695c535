//! Goal: a full step turns the walk by α, left is positive; after a deflection and its restoration the feet are
//! parallel; turning hardly tilts the soles.
//!
//! Method: forward kinematics from sole to sole, footprint after footprint.

mod common;

use gait::{DeflectionPhase, GaitParameters, RampKind, Walk};
use interface::{Command, GaitChange};
use model::{Joint, Mechanism, Side};
use nalgebra::{Isometry2, Vector2};
use proptest::prelude::*;

/// The footprint at the end of the present half-step, relative to the support footprint, in the plane of the floor.
fn next_footprint(walk: &Walk, mechanism: &Mechanism) -> Isometry2<f64> {
    let sole = common::left_sole_to_right_sole(mechanism, &walk.motion_at(1.0).angles);
    let side = match walk.half_step().support {
        Side::Right => 1.0,
        Side::Left => -1.0,
    };
    let place = sole.translation.vector;
    Isometry2::new(Vector2::new(place.x, side * place.y), side * common::heading(&sole))
}

fn finish_half_step(walk: &mut Walk) {
    while !walk.advance(0.01) {}
}

#[test]
fn a_full_step_turns_the_walk_by_the_commanded_angle() {
    let mechanism = common::mechanism();
    for ramp in [RampKind::Linear, RampKind::Quintic] {
        for degrees in [-30.0, -7.0, 0.0, 12.0, 25.0_f64] {
            let command = Command { turn: degrees.to_radians(), ..Command::NOMINAL };
            let parameters = GaitParameters { ramp, ..common::parameters() };
            let support = if degrees < 0.0 { Side::Left } else { Side::Right };
            let mut walk = common::walk(&parameters, support, command);
            let mut footprint = Isometry2::identity();
            for full_step in 1..=4 {
                for _ in 0..2 {
                    footprint *= next_footprint(&walk, &mechanism);
                    finish_half_step(&mut walk);
                }
                let turned = f64::from(full_step) * degrees.to_radians();
                let off = Isometry2::rotation(turned).rotation.angle_to(&footprint.rotation);
                assert!(off.abs() < 1e-12, "{degrees}° {ramp:?}: after {full_step} full steps {off} rad off");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn feet_are_parallel_after_a_deflection_and_its_restoration(stream in common::streams(), linear: bool) {
        let ramp = if linear { RampKind::Linear } else { RampKind::Quintic };
        let parameters = GaitParameters { ramp, ..common::parameters() };
        let mut walk = common::walk(&parameters, Side::Right, Command::NOMINAL);
        let mechanism = common::mechanism();
        let mut outward: Option<f64> = None;
        for (ticks, request) in stream {
            // A sidestep tilts the axis of the turn.
            walk.admit(&GaitChange { sidestep: None, ..request });
            for _ in 0..ticks {
                if !walk.advance(0.003) {
                    continue;
                }
                let end = walk.motion_at(1.0).angles;
                let sole = common::left_sole_to_right_sole(&mechanism, &end);
                match walk.turn().phase() {
                    DeflectionPhase::Deflect => {
                        // The swing foot always turns out, and only when the feet were parallel.
                        prop_assert_eq!(outward, None);
                        outward = Some(common::heading(&sole));
                        prop_assert!((common::heading(&sole) - walk.turn().angle().abs()).abs() < 1e-12);
                    }
                    DeflectionPhase::Restore | DeflectionPhase::Straight => {
                        outward = None;
                        prop_assert_eq!(end[Joint::RightHipYaw] + end[Joint::LeftHipYaw], 0.0);
                        prop_assert!(common::heading(&sole).abs() < 1e-12);
                    }
                }
            }
        }
    }
}

/// Yaw at the hips is about an axis that the legs' roll has tilted. In the synthetic half-step the roll reaches 2.9°
/// amid the half-step and is zero at its ends: turning by 30° tilts the swinging sole by up to 1.02° on the way, and
/// not at all at touchdown.
#[test]
fn turning_tilts_the_soles_little_and_not_at_touchdown() {
    let mechanism = common::mechanism();
    let turn = 30_f64.to_radians();
    let turning = Command { turn, ..Command::NOMINAL };
    let mut walk = common::walk(&common::parameters(), Side::Right, turning);
    let mut largest: f64 = 0.0;
    for phase in [DeflectionPhase::Deflect, DeflectionPhase::Restore, DeflectionPhase::Deflect] {
        assert_eq!(walk.turn().phase(), phase);
        let tilt_at = |progress: f64| {
            common::tilt(&common::left_sole_to_right_sole(&mechanism, &walk.motion_at(progress).angles))
        };
        assert!(tilt_at(1.0) < 1e-9);
        largest = (0..=100).map(|percent| tilt_at(0.01 * f64::from(percent))).fold(largest, f64::max);
        finish_half_step(&mut walk);
    }
    let lean_times_turn = common::SWAY * turn;
    assert!(largest < lean_times_turn, "{}°", largest.to_degrees());
    assert!(largest > 0.3 * lean_times_turn, "the coupling is there, small as it is: {}°", largest.to_degrees());
}
