//! What a reply accepts is what the robot does. What it does not, or not yet, is told: in place, after a fault, with
//! nothing to reset.

use std::f64::consts::FRAC_PI_6;

use halfstep_tests::walking::Walking;
use interface::{GaitChange, Intent, Mode, Reason, Reply, Verdict};
use plant::{SensorFault, SensorFaultKind};

fn reply(walking: &mut Walking, gait: GaitChange, intent: Option<Intent>) -> Reply {
    walking.ask(gait, intent).reply.expect("a reply within a half-step")
}

const FAST_AND_LONG: GaitChange = GaitChange { speed: Some(1.2), extension: Some(0.1), ..GaitChange::NONE };
const SLOW_AND_TURNING: GaitChange = GaitChange { turn: Some(0.3), speed: Some(0.8), ..GaitChange::NONE };

#[test]
fn in_place_a_high_speed_and_an_extension_wait_for_the_walk_and_the_reply_tells() {
    let mut walking = Walking::begin(11);
    walking.walk(1.0);
    let waiting = reply(&mut walking, FAST_AND_LONG, Some(Intent::InPlace));
    assert_eq!((waiting.verdict, waiting.reason), (Verdict::Limited, Reason::InPlace), "{waiting:?}");
    walking.walk(4.0);
    let again = reply(&mut walking, FAST_AND_LONG, None);
    assert_eq!((again.verdict, again.reason), (Verdict::Limited, Reason::InPlace), "{again:?}");
    assert!(walking.tick(None).report.speed <= 1.0);

    let walked = reply(&mut walking, SLOW_AND_TURNING, None);
    assert_eq!((walked.verdict, walked.reason), (Verdict::Accepted, Reason::None), "{walked:?}");
    walking.walk(3.0);
    assert!((walking.tick(None).report.speed - 0.8).abs() < 1e-6);

    reply(&mut walking, FAST_AND_LONG, None);
    let started = reply(&mut walking, GaitChange::NONE, Some(Intent::Walk));
    assert_eq!(started.verdict, Verdict::Accepted);
    assert_eq!((started.granted.speed, started.granted.extension), (1.2, 0.1), "now it is walked");
    walking.walk(4.0);
    assert!((walking.tick(None).report.speed - 1.2).abs() < 1e-6);
}

/// What is stored in place is checked as the walk that it is for.
#[test]
fn gait_parameters_are_limited_in_place_as_they_are_walked() {
    let extreme = GaitChange { turn: Some(FRAC_PI_6), speed: Some(1.5), extension: Some(0.2094), ..GaitChange::NONE };
    let mut walking = Walking::begin(12);
    walking.walk(1.0);
    reply(&mut walking, GaitChange::NONE, Some(Intent::InPlace));
    walking.walk(4.0);
    let stored = reply(&mut walking, extreme, None);
    assert_eq!((stored.verdict, stored.reason), (Verdict::Limited, Reason::YawTorque), "{stored:?}");
    assert!(stored.granted.extension < 0.2, "{stored:?}");
    let started = reply(&mut walking, extreme, Some(Intent::Walk));
    assert_eq!((started.verdict, started.reason), (Verdict::Limited, Reason::YawTorque), "{started:?}");
}

#[test]
fn after_a_fault_a_stop_tells_that_the_robot_stays_in_stride_and_takes_no_gait_parameters() {
    let mut walking = Walking::begin(13);
    walking.walk(2.0);
    let fault = SensorFault { start: walking.time() + 0.1, duration: 0.2, kind: SensorFaultKind::DropOut };
    walking.plant.disturbances.sensor_faults.push(fault);
    walking.walk(4.0);
    assert_eq!(walking.controller().mode(), Mode::Faulted);

    let held = reply(&mut walking, GaitChange::NONE, Some(Intent::Hold));
    assert_eq!((held.verdict, held.intent), (Verdict::Accepted, Some(Intent::Hold)));
    let stop = reply(&mut walking, GaitChange::NONE, Some(Intent::Stop));
    assert_eq!((stop.verdict, stop.reason), (Verdict::Limited, Reason::Faulted));
    assert_eq!(stop.intent, Some(Intent::Hold), "what is in force");
    let with_values = reply(&mut walking, SLOW_AND_TURNING, Some(Intent::Hold));
    assert_eq!((with_values.verdict, with_values.reason), (Verdict::Limited, Reason::Faulted));
    assert_eq!((with_values.granted.turn, with_values.granted.speed), (0.0, 1.0));

    let reset = reply(&mut walking, GaitChange::NONE, Some(Intent::Reset));
    assert_eq!(reset.verdict, Verdict::Accepted);
    let stop = reply(&mut walking, GaitChange::NONE, Some(Intent::Stop));
    assert_eq!(stop.verdict, Verdict::Accepted);
    walking.walk(4.0);
    assert_eq!(walking.controller().mode(), Mode::Standing, "now it is walked");
}

#[test]
fn gait_parameters_with_a_stop_are_in_force_once_the_robot_walks_again() {
    let mut walking = Walking::begin(14);
    walking.walk(2.0);
    let stop = reply(&mut walking, SLOW_AND_TURNING, Some(Intent::Stop));
    assert_eq!((stop.verdict, stop.granted.speed, stop.granted.turn), (Verdict::Accepted, 0.8, 0.3));
    walking.walk(4.0);
    assert_eq!(walking.controller().mode(), Mode::Standing);
    let started = reply(&mut walking, GaitChange::NONE, Some(Intent::Walk));
    assert_eq!((started.verdict, started.granted), (Verdict::Accepted, stop.granted));
    walking.walk(4.0);
    assert!((walking.tick(None).report.speed - 0.8).abs() < 1e-6);
}

#[test]
fn a_reset_with_nothing_to_reset_is_refused() {
    let mut walking = Walking::begin(15);
    walking.walk(1.0);
    let reset = reply(&mut walking, GaitChange::NONE, Some(Intent::Reset));
    assert_eq!((reset.verdict, reset.reason), (Verdict::Refused, Reason::NothingToReset));
    walking.walk(1.0);
    assert_eq!(walking.controller().mode(), Mode::Walking);
}
