//! `kill -9` of any process at any instant: the next start works and finds nothing left, what was recorded is read and
//! replays to the same bits. `survey kill` repeats it a thousand times.

use std::time::Duration;

use halfstep_tests::command_line::CommandLine;
use halfstep_tests::kill_trial::{Phase, Victim, kill};

fn kills(cases: &[(Victim, Phase, u64)]) {
    for &(victim, phase, delay_ms) in cases {
        let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
        let aftermath = kill(&command_line, victim, phase, Duration::from_millis(delay_ms));
        assert!(aftermath.is_clean(), "{victim:?} {phase:?} {delay_ms} ms: {aftermath:#?}");
    }
}

#[test]
fn kills_in_the_first_tenth_of_a_second() {
    kills(&[12, 21, 34].map(|delay| (Victim::Controller, Phase::Starting, delay)));
    kills(&[15, 28].map(|delay| (Victim::Plant, Phase::Starting, delay)));
    kills(&[(Victim::Walk, Phase::Starting, 60), (Victim::Send, Phase::Starting, 10)]);
}

#[test]
fn kills_of_loops() {
    kills(&[
        (Victim::Controller, Phase::Requested, 1),
        (Victim::Controller, Phase::Exiting, 5),
        (Victim::Plant, Phase::Standing, 3),
    ]);
}

#[test]
fn kills_of_a_walk_and_of_clients() {
    kills(&[
        (Victim::Walk, Phase::Walking, 7),
        (Victim::Stream, Phase::Walking, 40),
        (Victim::Observer, Phase::Walking, 60),
    ]);
}
