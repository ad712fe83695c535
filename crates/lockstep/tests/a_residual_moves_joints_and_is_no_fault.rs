//! Goal: what a policy adds to the joints is obeyed within their limits, and is no fault of a drive or an encoder; what
//! is no number adds nothing, to the bit.

use interface::{Intent, Mode, Request, Source};
use lockstep::{LockstepOptions, LockstepWalk, WalkableRobot};
use model::{Joint, JointVector};
use plant::Disturbances;

/// A walk from a stand with a residual from 2 s on, and its mode after 6 s.
fn walked(residual: Option<JointVector>) -> (LockstepWalk, Mode) {
    let robot = WalkableRobot::in_the_box("paper").expect("it is in the box");
    let walk = Request { intent: Some(Intent::Walk), ..Request::new(Source::Script) };
    let options = LockstepOptions { seed: 5, ..LockstepOptions::default() };
    let mut walk = LockstepWalk::new(&robot, &options, [walk], Disturbances::default()).expect("it walks");
    let mut mode = Mode::Standing;
    for tick in 0..6000 {
        if tick == 2000 {
            residual.iter().for_each(|residual| walk.set_joint_residual(residual));
        }
        let step = walk.step(&mut |_| {});
        assert_eq!(step.latched, None, "tick {tick}");
        mode = step.report.mode;
    }
    (walk, mode)
}

#[test]
fn an_elbow_is_moved_and_the_walk_goes_on() {
    let plain = walked(None).0;
    for (asked, expected) in [(-0.15, -0.15), (-100.0, -0.3), (0.2, 0.2)] {
        let mut residual = JointVector::ZERO;
        residual[Joint::LeftElbow] = asked;
        let (walk, mode) = walked(Some(residual));
        let [moved, there] = [&walk, &plain].map(|walk| walk.plant().robot.angles[Joint::LeftElbow]);
        assert!((moved - there - expected).abs() < 0.02, "{asked}: {moved} beside {there}");
        assert_eq!((mode, walk.plant().truth().has_fallen()), (Mode::Walking, false));
    }
}

#[test]
fn what_adds_nothing_changes_no_bit() {
    let plain = walked(None).0.setpoints();
    let no_number = JointVector::from_fn(|joint| if joint.index() % 2 == 0 { f64::NAN } else { f64::INFINITY });
    for nothing in [JointVector::ZERO, no_number] {
        assert_eq!(walked(Some(nothing)).0.setpoints(), plain);
    }
}
