//! Goal: the reply names the half-step at which a request takes effect, and until then nothing of it shows.
//!
//! Method: after each request of a random stream, compare with a walk that did not get it, half-step by half-step.

mod common;

use std::sync::Arc;

use gait::{GaitParameters, Start, Walk, WalkError};
use interface::{Command, GaitChange, Reason, Verdict};
use model::Side;
use proptest::prelude::*;

/// The first half-step, looking ahead, in which the two walks' offsets differ.
fn first_difference(mut changed: Walk, mut unchanged: Walk) -> Option<u64> {
    for _ in 0..6 {
        if changed.turn().per_hip(1.0) != unchanged.turn().per_hip(1.0)
            || changed.extension().per_hip(1.0) != unchanged.extension().per_hip(1.0)
            || changed.sidestep().per_hip(1.0) != unchanged.sidestep().per_hip(1.0)
        {
            return Some(changed.half_step().index);
        }
        while !changed.advance(0.01) {}
        while !unchanged.advance(0.01) {}
    }
    None
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_single_change_takes_effect_first_in_the_reported_half_step(stream in common::streams(), which in 0..2) {
        let mut walk = common::walk(&common::parameters(), Side::Right, Command::NOMINAL);
        for (ticks, request) in stream {
            let request = match which {
                0 => GaitChange { turn: request.turn, ..GaitChange::default() },
                _ => GaitChange { extension: request.extension, ..GaitChange::default() },
            };
            let (unchanged, in_force) = (walk.clone(), walk.command());
            let admission = walk.admit(&request);
            let now = walk.half_step().index;
            prop_assert_eq!(admission.granted, walk.command());
            if admission.granted == in_force {
                prop_assert_eq!(admission.effect_half_step, now);
            } else if let Some(first) = first_difference(walk.clone(), unchanged) {
                // A turn to the other side may show earlier by what no longer happens.
                let other_side = admission.granted.turn * in_force.turn < 0.0;
                prop_assert!(first > now);
                prop_assert!(first == admission.effect_half_step || other_side && first < admission.effect_half_step);
            }
            for _ in 0..ticks {
                walk.advance(0.003);
            }
        }
    }
}

#[test]
fn turns_wait_for_the_foot_that_can_deflect() {
    let turn = |degrees: f64| GaitChange { turn: Some(degrees.to_radians()), ..GaitChange::default() };
    let on_right = common::walk(&common::parameters(), Side::Right, Command::NOMINAL);
    assert_eq!(on_right.clone().admit(&turn(-10.0)).effect_half_step, 1);
    let mut walk = on_right;
    assert_eq!(walk.admit(&turn(10.0)).effect_half_step, 2);
    assert_eq!(walk.admit(&turn(10.0)).effect_half_step, 0, "the same again changes nothing");
    while walk.half_step().index < 2 {
        walk.advance(0.01);
    }
    // Deflecting to the left on the right foot: half-step 3 restores, whatever the command.
    assert_eq!(walk.clone().admit(&turn(0.0)).effect_half_step, 4);
    assert_eq!(walk.clone().admit(&turn(20.0)).effect_half_step, 4);
    assert_eq!(walk.clone().admit(&turn(-20.0)).effect_half_step, 5);
}

#[test]
fn a_set_of_changes_takes_effect_with_its_latest_one() {
    let mut walk = common::walk(&common::parameters(), Side::Right, Command::NOMINAL);
    let speed = GaitChange { speed: Some(1.1), ..GaitChange::default() };
    assert_eq!(walk.admit(&speed).effect_half_step, 0);
    let both = GaitChange { extension: Some(0.05), ..speed };
    assert_eq!(walk.admit(&both).effect_half_step, 1);
    let all = GaitChange { turn: Some(0.1), extension: Some(0.02), speed: Some(9.0), ..GaitChange::NONE };
    let admission = walk.admit(&all);
    assert_eq!((admission.effect_half_step, admission.verdict), (2, Verdict::Limited));
    assert_eq!(walk.command(), Command { turn: 0.1, speed: 1.4, extension: 0.02, sidestep: 0.0 });
}

#[test]
fn a_refused_request_changes_nothing() {
    let mut walk = common::walk(&common::parameters(), Side::Right, Command::NOMINAL);
    walk.advance(0.1);
    let bad = GaitChange { turn: Some(0.1), speed: Some(f64::NAN), extension: Some(0.1), sidestep: Some(0.1) };
    let mut other = walk.clone();
    let admission = other.admit(&bad);
    assert_eq!((admission.verdict, admission.granted), (Verdict::Refused, Command::NOMINAL));
    assert_eq!(admission.objection.map(|objection| objection.reason), Some(Reason::NotFinite));
    for _ in 0..2000 {
        walk.advance(0.001);
        other.advance(0.001);
        assert_eq!(walk.motion(), other.motion());
    }
}

#[test]
fn a_walk_that_cannot_be_walked_is_refused_at_the_start() {
    let mechanism = common::mechanism();
    let table = common::table(&mechanism);
    let begin = |table: gait::NominalTable, parameters: &GaitParameters, command: Command| {
        let start = Start { command, ..Start::default() };
        Walk::new(Arc::new(table), &mechanism, parameters, start).expect_err("not to be walked")
    };
    let usual = common::parameters();

    let mut other = table.clone();
    other.mechanism ^= 1;
    assert!(matches!(begin(other, &usual, Command::NOMINAL), WalkError::OtherMechanism { .. }));

    let mut jumping = table.clone();
    jumping.rows[24].motion.rates[model::Joint::LeftKnee] += 1e-5;
    let error = begin(jumping, &usual, Command::NOMINAL).to_string();
    assert!(error.contains("rate of joint 5 (right_knee)"), "{error}");

    let mut broken = table.clone();
    broken.rows[7].torque_dynamic[model::Joint::LeftKnee] = f64::NAN;
    assert_eq!(begin(broken, &usual, Command::NOMINAL).to_string(), "row 7 holds a value that is not a finite number");

    let mut backwards = usual;
    backwards.limits.speed_min = -0.5;
    assert!(matches!(begin(table.clone(), &backwards, Command::NOMINAL), WalkError::LimitsWithoutNominal { .. }));

    let fast = Command { speed: 3.0, ..Command::NOMINAL };
    assert_eq!(
        begin(table, &usual, fast).to_string(),
        "the walk cannot begin with speed 3: it must be at most 1.4 and at least 0"
    );
}
