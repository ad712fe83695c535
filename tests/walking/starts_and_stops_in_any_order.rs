//! Whatever an operator does in whatever order – change the walk, stop it, hold it, take that back, start again – the
//! robot does not fall, each stop ends in a stand and each start in walking.
//! `cargo run --release -p halfstep-survey -- start-stop` plays a thousand sequences.

use gait::Limits;
use halfstep_tests::random;
use halfstep_tests::sequence::{self, TO_STAND_MAX, TO_WALK_MAX, Tally};
use halfstep_tests::walking::{Walking, controller_parameters};
use interface::{GaitChange, Intent, Mode, Request, Source};
use rand::{Rng, rngs::StdRng};

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

/// Times between two commands (s): many come before the one before is answered.
const PAUSES: [f64; 8] = [0.02, 0.05, 0.1, 0.3, 0.6, 0.61, 1.2, 2.5];
const INTENTS: [Intent; 4] = [Intent::Stop, Intent::Hold, Intent::Walk, Intent::InPlace];

/// What a nervous hand asks for: any intent, and values from one end of the range to the other.
fn slammed(random: &mut StdRng, limits: &Limits) -> Request {
    let Limits { turn_max, speed_min, speed_max, extension_min, extension_max, sidestep_max } = *limits;
    let intent = random.random_bool(0.25).then(|| INTENTS[random.random_range(0..INTENTS.len())]);
    let turn = random.random_bool(0.6).then(|| [-turn_max, turn_max][random.random_range(0..2)]);
    let speed = random.random_bool(0.5).then(|| random.random_range(speed_min..=speed_max));
    let extension = random.random_bool(0.5).then(|| random.random_range(extension_min..=extension_max));
    let sidestep = random.random_bool(0.5).then(|| [-sidestep_max, sidestep_max][random.random_range(0..2)]);
    Request { gait: GaitChange { turn, speed, extension, sidestep }, intent, ..Request::new(Source::Script) }
}

#[test]
fn slammed_commands_lead_to_no_fall_and_no_stuck_mode() {
    let limits = controller_parameters().gait.limits;
    for seed in 1..7 {
        let mut walking = Walking::begin(seed);
        let mut random = random(seed);
        while walking.time() < 24.0 {
            let request = slammed(&mut random, &limits);
            let mut report = walking.tick_with(Some(&request).filter(|request| !request.is_empty()));
            let next = walking.time() + PAUSES[random.random_range(0..PAUSES.len())];
            while walking.time() < next && !walking.has_fallen(&report) {
                report = walking.tick(None);
            }
            assert!(!walking.has_fallen(&report), "seed {seed}: fell at {:.2} s after {request:?}", walking.time());
        }
        for (intent, mode, within) in
            [(Intent::Stop, Mode::Standing, TO_STAND_MAX), (Intent::Walk, Mode::Walking, TO_WALK_MAX)]
        {
            walking.ask(GaitChange::NONE, Some(intent));
            let reached = walking.walk_until(within, |tick| tick.report.mode == mode);
            assert!(reached.is_ok(), "seed {seed}: {intent} does not lead to {mode}: {reached:?}");
        }
    }
}
