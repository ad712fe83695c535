//! Entered from the nominal walk, the robot walks by each extreme of what is granted, alone and all three together, and
//! what is beyond is limited to it. `cargo run --release -p halfstep-survey -- single` and `grid` walk longer and look
//! at what lies between.

use gait::Limits;
use halfstep_tests::walking::{Walking, controller_parameters};
use interface::{Command, GaitChange, Intent, Mode, Verdict};

/// Half-steps of the nominal walk, and by the command.
const ENTRY: u64 = 3;
const HALF_STEPS: u64 = 12;

/// Walks by `request` and says what became of it.
fn walk(request: GaitChange) -> (Verdict, Command) {
    let mut walking = Walking::begin(0);
    let entered = walking.walk_until(5.0, |report| report.report.half_step.index == ENTRY);
    entered.unwrap_or_else(|report| panic!("the nominal walk fell in {:?}", report.report.half_step));
    let report = walking.ask(request, Some(Intent::Walk));
    let end = report.report.half_step.index + HALF_STEPS;
    let walked = walking.walk_until(2.0 * HALF_STEPS as f64, |report| report.report.half_step.index == end);
    let walked = walked.unwrap_or_else(|report| panic!("{request:?}: fell in {:?}", report.report.half_step));
    assert_eq!(walked.report.mode, Mode::Walking, "{request:?}");
    let reply = report.reply.expect("a request is answered");
    (reply.verdict, reply.granted)
}

#[test]
fn walks_by_each_extreme_alone() {
    let limits = controller_parameters().gait.limits;
    let Limits { turn_max, speed_min, speed_max, extension_min, extension_max, sidestep_max } = limits;
    for turn in [-turn_max, turn_max] {
        let (verdict, granted) = walk(GaitChange { turn: Some(turn), ..GaitChange::default() });
        assert_eq!((verdict, granted.turn), (Verdict::Accepted, turn));
    }
    for speed in [speed_min, speed_max] {
        let (verdict, granted) = walk(GaitChange { speed: Some(speed), ..GaitChange::default() });
        assert_eq!((verdict, granted.speed), (Verdict::Accepted, speed));
    }
    for extension in [extension_min, extension_max] {
        let (verdict, granted) = walk(GaitChange { extension: Some(extension), ..GaitChange::default() });
        assert_eq!((verdict, granted.extension), (Verdict::Accepted, extension));
    }
    for sidestep in [-sidestep_max, sidestep_max] {
        let (verdict, granted) = walk(GaitChange { sidestep: Some(sidestep), ..GaitChange::default() });
        assert_eq!((verdict, granted.sidestep), (Verdict::Accepted, sidestep));
    }
}

#[test]
fn requests_beyond_all_three_limits_are_limited_and_walked() {
    let beyond = [(0.4, 1.7), (-40_f64, 40_f64), (-12_f64, 16_f64)];
    for corner in 0..8 {
        let pick = |axis: usize| if corner >> axis & 1 == 0 { beyond[axis].0 } else { beyond[axis].1 };
        let request = GaitChange {
            speed: Some(pick(0)),
            turn: Some(pick(1).to_radians()),
            extension: Some(pick(2).to_radians()),
            ..GaitChange::NONE
        };
        let (verdict, _) = walk(request);
        assert_eq!(verdict, Verdict::Limited, "{request:?}");
    }
}
