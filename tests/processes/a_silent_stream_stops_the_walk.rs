//! A stream that is killed stops the walk after its age limit; one that takes its leave does not; while it is in
//! command, others are refused, but for a stop.

use halfstep_tests::command_line::{CommandLine, Ended, Running};
use halfstep_tests::walking::Walking;
use interface::{Intent, Lifetime, Mode, Reason, Request, Source};
use plots::run_log::RunLog;

#[test]
fn a_heartbeat_after_a_timeout_takes_command_but_starts_no_walk() {
    let mut walking = Walking::begin(1);
    let alive = Request { lifetime: Lifetime::Streamed, ..Request::new(Source::Teleop) };
    let walk = Request { intent: Some(Intent::Walk), ..alive };
    let other = Request { source: Source::Script, ..walk };
    for tick in 0..3000 {
        let report = walking.tick_with((tick % 500 == 0).then_some(&alive));
        assert_eq!(report.report.mode, Mode::Walking, "tick {tick}: it is heard");
        if tick % 500 == 250 {
            let refusal = walking.tick_with(Some(&other)).reply.map(|reply| reply.reason);
            assert_eq!(refusal, Some(Reason::Outranked));
        }
    }
    for _ in 0..3000 {
        walking.tick_with(None);
    }
    assert_eq!(walking.tick_with(Some(&alive)).report.mode, Mode::Standing, "it stopped");
    for _ in 0..400 {
        assert_eq!(walking.tick_with(None).report.mode, Mode::Standing, "a sign of life starts no walk");
    }
    walking.tick_with(Some(&walk));
    let mut modes: Vec<Mode> =
        (0..2500).map(|tick| walking.tick_with((tick % 400 == 0).then_some(&alive)).report.mode).collect();
    modes.dedup();
    assert_eq!(modes.last(), Some(&Mode::Walking), "{modes:?}");
    assert!(!walking.plant.truth().has_fallen());
}

/// A walk in lockstep, and a stream that has been granted something.
fn walk(command_line: &CommandLine, stream: &str) -> [Running; 3] {
    let controller = command_line.start_here("controller --lockstep --out log");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --lockstep --out log");
    let mut stream = command_line.start_here(stream);
    stream.type_on("{\"speed\":0.97}\n");
    assert!(stream.wait_for_line().starts_with("1: accepted"));
    [controller, plant, stream]
}

/// Lets both walk on for some seconds of their time, then ends them; gives the last mode.
fn last_mode(command_line: &CommandLine, [controller, plant]: [Running; 2]) -> String {
    let mut wait = command_line.start_here("stream");
    wait.type_in("{\"t\":8,\"turn_deg\":0}\n");
    wait.finish();
    for process in [plant, controller] {
        assert_eq!(process.end().code, Some(0));
    }
    let log = RunLog::read(&command_line.folder().join("log")).unwrap();
    assert_eq!(log.falls().count(), 0);
    log.controller.last().unwrap().mode.to_owned()
}

#[test]
fn a_killed_stream_stops_the_walk_and_a_closed_one_does_not() {
    for (is_killed, mode) in [(true, "standing"), (false, "walking")] {
        let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
        // Long, since lockstep runs many times as fast as the clock by which this machine schedules the stream.
        let [controller, plant, stream] = walk(&command_line, "stream --age-limit 5s");
        if is_killed {
            stream.kill();
        } else {
            assert_eq!(stream.finish().code, Some(0));
        }
        let last = last_mode(&command_line, [controller, plant]);
        assert_eq!(last, mode, "killed: {is_killed}");
    }
}

#[test]
fn lower_priority_requests_are_refused_except_for_a_stop() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let [_controller, _plant, mut stream] = walk(&command_line, "stream --age-limit 60s");
    let send = |words: &str| -> Ended {
        let ended = command_line.start_here(&format!("send {words}")).finish();
        assert_eq!(ended.stderr, "");
        ended
    };
    // A person goes before a script, and takes command with a limit.
    assert_eq!(send("turn 3").code, Some(0), "a single request goes before");
    assert_eq!(send("turn 3 --for 60s").code, Some(0), "it takes command over");
    stream.type_on("{\"speed\":1.02}\n");
    while stream.lines_so_far() < 2 {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    stream.type_on("{\"intent\":\"stop\"}\n");
    let ended = stream.finish();
    let replies: Vec<&str> = ended.stdout.lines().collect();
    assert!(replies[1].starts_with("2: refused: `console` is in control and outranks `script`"), "{replies:?}");
    assert!(replies[2].starts_with("3: accepted: stop, from half-step "), "{replies:?}");
}
