//! The controller begins where the robot is: a restart beside a standing robot stands, a robot in another posture is
//! held in it, and one that comes back is brought to a stand after a reset.

use std::sync::Arc;

use controller::{Controller, Driver, InlineWorker};
use gait::Start;
use halfstep_tests::mechanism;
use halfstep_tests::walking::{PERIOD, Walking, controller_parameters, nominal};
use interface::{Fault, GaitChange, Intent, Mode, Reason, Verdict};
use model::{Joint, JointVector};

/// A controller that has just been started, to walk at once.
fn restarted() -> Driver<InlineWorker> {
    let table = Arc::clone(&nominal());
    let controller = Controller::new(&mechanism(), table, &controller_parameters(), Start::default()).unwrap();
    Driver { controller, worker: InlineWorker }
}

/// A robot that stands, `intent` having brought it there.
fn standing(intent: Intent) -> Walking {
    let mut walking = Walking::begin(3);
    walking.walk(2.0);
    walking.ask(GaitChange::NONE, Some(intent));
    walking.walk(4.0);
    walking
}

#[test]
fn a_restart_beside_a_standing_robot_stands_and_walks_when_asked() {
    let mut walking = standing(Intent::Stop);
    *walking.driver = restarted();
    let before = walking.measurement.angles;
    let tick = walking.tick(None);
    assert!((tick.setpoint.angles - before).max_abs() < 0.02, "the first setpoint is where the joints are");
    walking.walk(4.0);
    let tick = walking.tick(None);
    assert_eq!((tick.report.mode, walking.plant.truth().has_fallen()), (Mode::Standing, false));
    walking.ask(GaitChange::NONE, Some(Intent::Walk));
    walking.walk(5.0);
    let tick = walking.tick(None);
    assert_eq!((tick.report.mode, walking.plant.truth().has_fallen()), (Mode::Walking, false));
}

#[test]
fn a_restart_beside_a_robot_in_stride_holds_it_and_says_why() {
    let mut walking = standing(Intent::Hold);
    *walking.driver = restarted();
    for _ in 0..4000 {
        let tick = walking.tick(None);
        assert_eq!(tick.report.mode, Mode::Faulted);
        assert_eq!(tick.rejection.map(|rejection| rejection.fault), Some(Fault::UnexpectedPosture));
    }
    assert!(!walking.plant.truth().has_fallen());
    let reply = walking.ask(GaitChange::NONE, Some(Intent::Reset)).reply.unwrap();
    assert_eq!((reply.verdict, reply.reason), (Verdict::Refused, Reason::NotInStand));
    assert!(reply.active_limit.is_some_and(|limit| limit.joint.is_some() && limit.value > limit.limit));
}

/// The robot is gone while it walks, and another one is there, held in a stand.
#[test]
fn a_robot_that_comes_back_in_a_stand_walks_again_after_a_reset() {
    let mut walking = Walking::begin(3);
    walking.walk(2.3);
    let mut controller = walking.driver;
    for _ in 0..1500 {
        controller.step(PERIOD, None, |_| None);
    }
    assert_eq!(controller.controller.mode(), Mode::Faulted);
    let mut back = standing(Intent::Stop);
    back.driver = controller;
    // It counts from the start again.
    back.measurement.sample = 0;
    let stood = back.measurement.angles;
    let held = back.tick_in(None, |plant, _| plant.hold());
    assert!((held.setpoint.angles - stood).max_abs() < 0.02, "nothing moves before a reset");
    let reset =
        interface::Request { intent: Some(Intent::Reset), ..interface::Request::new(interface::Source::Console) };
    let reply = back.tick_with(Some(&reset)).reply.unwrap();
    assert_eq!(reply.verdict, Verdict::Accepted, "{reply:?}");
    back.walk(4.0);
    assert_eq!(back.tick(None).report.mode, Mode::Standing);
    back.ask(GaitChange::NONE, Some(Intent::Walk));
    back.walk(5.0);
    assert_eq!((back.tick(None).report.mode, back.plant.truth().has_fallen()), (Mode::Walking, false));
}

/// An arm that is elsewhere is no reason to fall: it is brought back slowly.
#[test]
fn joints_move_slowly_from_where_they_are_found() {
    let mut walking = standing(Intent::Stop);
    *walking.driver = restarted();
    let mut angles: JointVector = walking.measurement.angles;
    angles[Joint::LeftShoulder] += 0.25;
    walking.measurement.angles = angles;
    let mut last = walking.tick(None).setpoint.angles;
    assert!((last[Joint::LeftShoulder] - angles[Joint::LeftShoulder]).abs() < 0.01);
    for _ in 0..3500 {
        let now = walking.tick(None).setpoint.angles;
        assert!((now - last).max_abs() < 5e-4, "a joint moves by {} rad in a period", (now - last).max_abs());
        last = now;
    }
}
