//! Pushes at the trunk of 0.1 s: the nominal walk survives 6 N·s to either side and 15 N·s from the front and the back,
//! whenever in the half-step they come.
//!
//! Method: lockstep; a walk is brought to each of 12 phases of a half-step, pushed, and walked on for three seconds.

use controller::Mode;
use halfstep_tests::walking::Walking;
use nalgebra::Vector3;

const PHASES: usize = 12;
/// Impulse [N·s] in world axes: x ahead, y left.
const PUSHES: [[f64; 2]; 4] = [[15.0, 0.0], [-15.0, 0.0], [0.0, 6.0], [0.0, -6.0]];

/// A walk at the beginning of each phase of its ninth half-step.
fn walks() -> Vec<Walking> {
    let mut walking = Walking::begin(1);
    let mut walks = Vec::new();
    while walks.len() < PHASES {
        let half_step = walking.tick(None).half_step;
        if half_step.index == 8 && half_step.progress >= walks.len() as f64 / PHASES as f64 {
            walks.push(walking.clone());
        }
    }
    walks
}

#[test]
fn at_every_phase_and_from_every_side() {
    for (phase, walk) in walks().iter().enumerate() {
        for [ahead, left] in PUSHES {
            let mut walking = walk.clone();
            walking.plant.push(Vector3::new(ahead, left, 0.0), 0.1);
            let truth = walking.walk(3.0);
            let report = walking.tick(None);
            let survives = !truth.has_fallen() && report.mode == Mode::Walking;
            assert!(survives, "{ahead} N·s ahead, {left} to the left at phase {phase} of {PHASES}");
        }
    }
}
