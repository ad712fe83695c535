//! A limit that is broken already, by a push for example, excuses no other one: every limit is compared by itself.

use std::f64::consts::FRAC_PI_6;

use halfstep_tests::walking::Walking;
use interface::{GaitChange, Intent, Reason, Reply, Verdict};
use nalgebra::Vector3;

const EXTREME: GaitChange =
    GaitChange { turn: Some(FRAC_PI_6), speed: Some(1.5), extension: Some(0.2094), ..GaitChange::NONE };

/// The reply 50 ms after a push (N·s), and the robot.
fn after_push(impulse: Vector3<f64>) -> (Reply, Walking) {
    let mut walking = Walking::begin(3);
    walking.walk(3.0);
    walking.plant.push(impulse, 0.1);
    walking.walk(0.05);
    let reply = walking.ask(EXTREME, Some(Intent::Walk)).reply.expect("a reply within a half-step");
    (reply, walking)
}

#[test]
fn a_pushed_robot_is_granted_no_more_than_an_undisturbed_one() {
    let (undisturbed, _) = after_push(Vector3::zeros());
    assert_eq!((undisturbed.verdict, undisturbed.reason), (Verdict::Limited, Reason::YawTorque), "{undisturbed:?}");
    for impulse in [Vector3::new(0.0, 12.0, 0.0), Vector3::new(0.0, -12.0, 0.0), Vector3::new(12.0, 0.0, 0.0)] {
        let (pushed, mut walking) = after_push(impulse);
        assert_ne!(pushed.verdict, Verdict::Accepted, "{impulse}: {pushed:?}");
        let most = undisturbed.granted;
        let more = [
            pushed.granted.turn - most.turn,
            pushed.granted.speed - most.speed,
            pushed.granted.extension - most.extension,
        ];
        // A sixteenth of each is the resolution of the search.
        assert!(more[0] < 0.04 && more[1] < 0.04 && more[2] < 0.02, "{impulse}: {pushed:?} against {undisturbed:?}");
        assert!(!walking.walk(5.0).has_fallen(), "{impulse}");
    }
}
