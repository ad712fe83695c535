//! Pushed at the trunk for a tenth of a second, from any side at any phase of the half-step, the robot walks on.
//! `cargo run --release -p halfstep-survey -- pushes` finds the largest impulse survived.

use halfstep_tests::pushing::{Direction, survives, walk_to};
use interface::GaitChange;

const PHASES: u32 = 12;

#[test]
fn walks_on_after_pushes_from_any_side_at_any_phase() {
    for phase in 0..PHASES {
        let progress = f64::from(phase) / f64::from(PHASES);
        let walking = walk_to(7, GaitChange::default(), 5, progress).expect("the nominal walk goes on");
        for direction in Direction::ALL {
            let impulse = direction.demanded();
            assert!(survives(&walking, direction, impulse), "{impulse} N·s {direction:?} at {progress:.2}");
        }
    }
}

/// The check above can fail.
#[test]
fn a_push_beyond_all_limits_makes_the_robot_fall() {
    let walking = walk_to(7, GaitChange::default(), 5, 0.5).expect("the nominal walk goes on");
    assert!(!survives(&walking, Direction::ToSwing, 60.0));
}
