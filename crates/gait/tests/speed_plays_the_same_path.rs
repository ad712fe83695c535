//! Goal: at a constant speed c the robot does at t what the nominal does at c·t, rates ×c, accelerations ×c²; while c
//! changes the path stays the same, and the term ċ·q′ is in the accelerations (eq. 4).
//!
//! Method: compare with the table; for ramps, with finite differences.

mod common;

use gait::{GaitParameters, RampKind};
use interface::{Command, GaitChange};
use model::Side;

#[test]
fn the_motion_at_constant_speed_is_the_nominal_scaled_in_time() {
    for c in [0.6, 0.95, 1.0, 1.4] {
        let mut walk = common::walk(&common::parameters(), Side::Right, Command { speed: c, ..Command::NOMINAL });
        for tick in 0..400 {
            let t = 0.001 * f64::from(tick);
            let nominal = walk.table().at(c * t / common::DURATION);
            let motion = walk.motion();
            assert!((motion.angles - nominal.angles).max_abs() < 1e-12);
            assert!((motion.rates - nominal.rates * c).max_abs() < 1e-11);
            assert!((motion.accelerations - nominal.accelerations * (c * c)).max_abs() < 1e-10);
            walk.advance(0.001);
        }
    }
}

#[test]
fn the_path_stays_while_the_speed_changes_and_accelerations_include_the_change() {
    let dt = 1e-4;
    for ramp in [RampKind::Linear, RampKind::Quintic] {
        let parameters = GaitParameters { ramp, ..common::parameters() };
        let mut walk = common::walk(&parameters, Side::Right, Command::NOMINAL);
        walk.admit(&GaitChange { speed: Some(1.4), ..GaitChange::default() });
        let mut largest_share: f64 = 0.0;
        for _ in 0..4000 {
            walk.advance(dt);
            let (mut next, mut after) = (walk.clone(), walk.clone());
            next.advance(dt);
            after.advance(2.0 * dt);
            if after.half_step().index > 0 {
                break;
            }
            let difference = (after.motion().rates - walk.motion().rates) * (0.5 / dt);
            assert!((difference - next.motion().accelerations).max_abs() < 1e-4, "{ramp:?}");
            let at = next.table().at(next.half_step().progress);
            assert_eq!(next.motion().angles, at.angles);
            largest_share = largest_share.max((at.rates * next.speed().state().rate).max_abs());
        }
        assert!(largest_share > 0.5, "the term is there to be found: {largest_share} rad/s²");
    }
}

#[test]
fn a_commanded_speed_is_reached_after_the_configured_time() {
    let mut walk = common::walk(&common::parameters(), Side::Right, Command::NOMINAL);
    walk.admit(&GaitChange { speed: Some(0.8), ..GaitChange::default() });
    for _ in 0..599 {
        walk.advance(0.001);
    }
    assert!(walk.speed().state().value > 0.8);
    walk.advance(0.0011);
    assert_eq!(walk.speed().state().value, 0.8);
}
