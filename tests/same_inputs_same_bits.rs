//! The same measurements and requests give the same setpoints to the last bit, and so does a whole simulated walk.

use gait::Request;
use halfstep_tests::walking::Walking;

fn setpoints(seed: u64) -> Vec<[u64; 20]> {
    let mut walking = Walking::begin(seed);
    let turn = Request { turn: Some(0.05), speed: Some(1.03), extension: Some(-0.02) };
    (0..5000)
        .map(|tick| {
            let report = walking.tick((tick == 700).then_some((&turn, None)));
            report.setpoint.angles.0.map(f64::to_bits)
        })
        .collect()
}

#[test]
fn in_a_walk_with_noise() {
    assert_eq!(setpoints(3), setpoints(3));
}

/// The noise matters: else the statement above would say little.
#[test]
fn and_other_noise_other_bits() {
    assert_ne!(setpoints(3), setpoints(4));
}
