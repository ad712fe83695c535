//! The same measurements and requests give the same setpoints to the last bit, and so does a whole simulated walk.

use halfstep_tests::walking::Walking;
use interface::GaitChange;

fn setpoints(seed: u64) -> Vec<[u64; 20]> {
    let mut walking = Walking::begin(seed);
    let turn = GaitChange { turn: Some(0.05), speed: Some(1.03), extension: Some(-0.02), ..GaitChange::NONE };
    (0..5000)
        .map(|tick| {
            let report = walking.tick((tick == 700).then_some((&turn, None)));
            report.setpoint.angles.0.map(f64::to_bits)
        })
        .collect()
}

#[test]
fn two_walks_with_the_same_inputs_have_the_same_bits() {
    assert_eq!(setpoints(3), setpoints(3));
}

/// The noise matters: else the statement above would say little.
#[test]
fn walks_with_other_noise_have_other_bits() {
    assert_ne!(setpoints(3), setpoints(4));
}
