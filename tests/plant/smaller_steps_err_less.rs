//! The plant converges: half the integration step, half the error, through touchdown, slip and all; and as committed it
//! is near enough to the limit.

use halfstep_tests::mechanism;
use halfstep_tests::replaying::{Apart, Reference};
use halfstep_tests::walking::plant_parameters;
use plant::Plant;

/// Of the walk from which it is played again (control periods): all phases of two half-steps.
const STARTS: std::ops::Range<usize> = 600..1800;
const EVERY: usize = 60;
/// For how long it is played (control periods).
const AFTER: usize = 100;
/// What MuJoCo errs in steps of 1 ms on its own walk (survey `accuracy`) (rad, m, rad).
const MUJOCO: Apart = Apart { joints: 2.7e-5, place: 5.0e-5, turn: 1.67e-4 };

#[test]
fn half_the_integration_step_halves_the_error() {
    let mechanism = mechanism();
    let walk = Reference::walk(&mechanism, STARTS.end + AFTER + 1, Plant::step);
    let starts: Vec<usize> = STARTS.step_by(EVERY).collect();
    let apart = |steps: u32| {
        let [apart] = walk.apart(&mechanism, &starts, [AFTER], |plant| {
            let mut plant = plant.clone();
            plant.set_steps_per_period(steps);
            (plant, Plant::step)
        });
        apart
    };

    let errors = [2, 4, 8].map(apart);
    for pair in errors.windows(2) {
        let (coarse, fine) = (pair[0], pair[1]);
        for ratio in [coarse.joints / fine.joints, coarse.place / fine.place, coarse.turn / fine.turn] {
            // The reference errs, too, by a hundredth of a period's step.
            assert!((1.7..2.5).contains(&ratio), "{coarse:?} in steps twice as long as {fine:?}");
        }
    }

    let committed = apart(plant_parameters().steps_per_period);
    assert!(committed.joints < MUJOCO.joints, "{committed:?}");
    assert!(committed.place < MUJOCO.place, "{committed:?}");
    assert!(committed.turn < MUJOCO.turn, "{committed:?}");
}
