//! Whatever an operator does in whatever order – change the walk, stop it, hold it, take that back, start again – the
//! robot does not fall, each stop ends in a stand and each start in walking.
//! `cargo run --release -p halfstep-survey -- start-stop` plays a thousand sequences.

use halfstep_tests::random;
use halfstep_tests::sequence::{self, Tally};
use halfstep_tests::walking::{Walking, controller_parameters};

#[test]
fn random_starts_and_stops_lead_to_no_fall_and_no_stuck_mode() {
    let limits = controller_parameters().gait.limits;
    let mut all = Tally::default();
    for seed in 5000..5008 {
        let played = sequence::play(&mut Walking::begin(seed), &mut random(seed), &limits, 12);
        let tally = played.unwrap_or_else(|trouble| panic!("seed {seed}: {trouble:?}"));
        all.stops += tally.stops;
        all.starts += tally.starts;
        all.changes += tally.changes;
    }
    assert!(all.stops > 10 && all.starts > 10 && all.changes > 20, "the sequences do what they should: {all:?}");
}

/// Stops from fast turns with long steps, asked for shortly before a swap, led to falls in these.
#[test]
fn stops_just_before_a_support_change_lead_to_no_fall() {
    let limits = controller_parameters().gait.limits;
    for seed in [541, 672, 1438] {
        let played = sequence::play(&mut Walking::begin(seed), &mut random(seed), &limits, 15);
        assert!(played.is_ok(), "seed {seed}: {played:?}");
    }
}
