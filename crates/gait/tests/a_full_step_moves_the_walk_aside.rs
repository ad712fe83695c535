//! Goal: a full step moves the walk aside by `γ` at the hips, left is positive; the foot on that side leads; the soles
//! stay level and parallel, and are as far apart as before after the second half-step.
//!
//! Method: forward kinematics from sole to sole with both mechanisms, whose ankles have their axes in opposite order.

mod common;

use std::sync::Arc;

use gait::{DeflectionPhase, GaitParameters, RampKind, Start, Walk};
use interface::Command;
use model::{Mechanism, Side};

fn walk(mechanism: &Mechanism, ramp: RampKind, degrees: f64) -> Walk {
    let command = Command { sidestep: degrees.to_radians(), ..Command::NOMINAL };
    let parameters = GaitParameters { ramp, ..common::parameters() };
    let start = Start { support: Side::Right, command };
    Walk::new(Arc::new(common::table(mechanism)), mechanism, &parameters, start).expect("a valid walk")
}

/// How far to the left of the support sole the swing sole lands (m).
fn landing(walk: &Walk, mechanism: &Mechanism) -> f64 {
    let sole = common::left_sole_to_right_sole(mechanism, &walk.motion_at(1.0).angles);
    walk.half_step().support.lateral_sign() * sole.translation.y
}

#[test]
fn the_foot_on_the_side_of_the_walk_leads_and_the_other_one_follows() {
    for mechanism in [common::mechanism(), common::other_reading()] {
        let width = mechanism.foot_distance();
        for degrees in [-12.0, -5.0, 6.0, 15.0_f64] {
            let mut walk = walk(&mechanism, RampKind::Quintic, degrees);
            let leads = if degrees > 0.0 { Side::Left } else { Side::Right };
            let mut full_steps = 0;
            for _ in 0..8 {
                let swings = walk.half_step().support.other();
                let aside = landing(&walk, &mechanism);
                match walk.sidestep().phase() {
                    DeflectionPhase::Deflect => {
                        assert_eq!(swings, leads);
                        full_steps += 1;
                        // Two legs of 0.856 m, a little bent, each turned by γ/2.
                        let spread = 2.0 * 0.856 * (0.5 * degrees.abs().to_radians()).sin();
                        assert!((aside.abs() - width - spread).abs() < 0.06 * spread, "{degrees}°: {aside}");
                    }
                    DeflectionPhase::Restore | DeflectionPhase::Straight => {
                        assert!((aside.abs() - width).abs() < 1e-9, "{degrees}°: {aside}");
                    }
                }
                assert!(aside * walk.half_step().support.lateral_sign() > 0.0, "the swing foot stays on its own side");
                while !walk.advance(0.01) {}
            }
            assert!(full_steps >= 3, "{degrees}°");
        }
    }
}

#[test]
fn soles_are_level_and_parallel_throughout_a_sidestep() {
    let mechanism = common::mechanism();
    for ramp in [RampKind::Linear, RampKind::Quintic] {
        for degrees in [-15.0, 4.0, 15.0] {
            let mut walk = walk(&mechanism, ramp, degrees);
            for _ in 0..500 {
                let sole = common::left_sole_to_right_sole(&mechanism, &walk.motion().angles);
                assert!(common::tilt(&sole) < 1e-9, "{degrees}°: tilted by {} rad", common::tilt(&sole));
                assert!(common::heading(&sole).abs() < 1e-9, "{degrees}°: turned");
                walk.advance(0.005);
            }
        }
    }
}
