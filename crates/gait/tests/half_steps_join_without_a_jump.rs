//! Goal: whatever is requested whenever, no joint jumps in angle, and with quintic ramps in rate, at any tick or
//! support change; and the rates and accelerations are the derivatives of the angles and rates.
//!
//! Method: random request streams; from tick to tick each joint is compared with the trapezoidal rule over the
//! derivative, whose error is bounded by the largest jerk there is (estimated by hand: about 400 rad/s³ for the largest
//! turn at c = 1.4). A jump in rate of 1 mrad/s or in angle of 1 µrad would be found.

mod common;

use gait::{GaitParameters, RampKind};
use interface::{Command, GaitChange};
use model::{Joint, Motion, Side};
use proptest::prelude::*;

const DT: f64 = 0.001;
/// (rad/s³)
const JERK_MAX: f64 = 800.0;

/// By how much rates changed beyond what the accelerations account for (rad/s).
fn rate_jump(before: &Motion, after: &Motion) -> f64 {
    (after.rates - before.rates - (before.accelerations + after.accelerations) * (0.5 * DT)).max_abs()
}

/// By how much angles changed beyond what the rates account for (rad).
fn angle_jump(before: &Motion, after: &Motion) -> f64 {
    (after.angles - before.angles - (before.rates + after.rates) * (0.5 * DT)).max_abs()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn quintic_ramps_keep_every_joint_continuous_in_angle_and_rate(stream in common::streams(), left: bool) {
        let support = if left { Side::Left } else { Side::Right };
        let mut walk = common::walk(&common::parameters(), support, Command::NOMINAL);
        let mut before = walk.physical_motion();
        for (ticks, request) in stream {
            walk.admit(&request);
            for _ in 0..ticks {
                walk.advance(DT);
                let after = walk.physical_motion();
                prop_assert!(rate_jump(&before, &after) <= DT * DT * JERK_MAX, "{:?}", walk.half_step());
                prop_assert!(angle_jump(&before, &after) <= DT * DT * DT * JERK_MAX, "{:?}", walk.half_step());
                before = after;
            }
        }
    }

    #[test]
    fn linear_ramps_keep_every_joint_continuous_in_angle(stream in common::streams()) {
        let parameters = GaitParameters { ramp: RampKind::Linear, ..common::parameters() };
        let mut walk = common::walk(&parameters, Side::Right, Command::NOMINAL);
        let mut before = walk.physical_motion();
        for (ticks, request) in stream {
            walk.admit(&request);
            for _ in 0..ticks {
                walk.advance(DT);
                let after = walk.physical_motion();
                for joint in Joint::ALL {
                    // Within a tick the rate may have had either value; in between it moves by less than 0.1 rad/s.
                    let fastest = before.rates[joint].abs().max(after.rates[joint].abs()) + 0.1;
                    let moved = (after.angles[joint] - before.angles[joint]).abs();
                    prop_assert!(moved <= DT * fastest, "{joint:?} moved {moved} at {:?}", walk.half_step());
                }
                before = after;
            }
        }
    }
}

/// Largest jump of a rate from tick to tick in two full steps of turning.
fn largest_rate_jump(ramp: RampKind) -> f64 {
    let turning = Command { turn: 20_f64.to_radians(), ..Command::NOMINAL };
    let mut walk = common::walk(&GaitParameters { ramp, ..common::parameters() }, Side::Right, turning);
    let mut before = walk.physical_motion();
    let mut largest: f64 = 0.0;
    for _ in 0..2400 {
        walk.advance(DT);
        let after = walk.physical_motion();
        largest = largest.max(rate_jump(&before, &after));
        before = after;
    }
    largest
}

#[test]
fn linear_turn_ramps_jump_in_rate_at_the_support_change_and_quintic_ones_do_not() {
    // Deflecting at α/2 per T, then restoring at as much: the rate jumps by twice that.
    let expected = 20_f64.to_radians() / common::DURATION;
    let linear = largest_rate_jump(RampKind::Linear);
    assert!((linear - expected).abs() < 1e-3 * expected, "{linear} instead of {expected}");
    assert!(largest_rate_jump(RampKind::Quintic) < 1e-3 * expected);
}

#[test]
fn progress_beyond_the_end_is_carried_over_to_the_next_half_step() {
    let mut walk = common::walk(&common::parameters(), Side::Right, Command::NOMINAL);
    walk.admit(&GaitChange { speed: Some(1.3), ..GaitChange::default() });
    let mut in_one = walk.clone();
    for _ in 0..12 {
        walk.advance(0.05);
    }
    assert!(in_one.advance(0.6));
    assert_eq!(in_one.half_step().index, 1);
    assert_eq!(in_one.half_step().index, walk.half_step().index);
    assert!((in_one.half_step().progress - walk.half_step().progress).abs() < 1e-12);
}

#[test]
fn a_time_step_that_is_not_positive_does_not_move_the_walk() {
    let mut walk = common::walk(&common::parameters(), Side::Right, Command::NOMINAL);
    walk.advance(0.1);
    let before = walk.half_step();
    for dt in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        assert!(!walk.advance(dt));
        assert_eq!(walk.half_step(), before);
    }
    assert!(walk.advance(f64::INFINITY));
    assert_eq!(walk.half_step().index, 1);
}
