//! A stream follows its newest line: lines that arrive faster than they are answered are passed over, and a stop waits
//! for nothing.

use halfstep_tests::command_line::{CommandLine, Running};
use serde_json::Value;

fn pair(command_line: &CommandLine) -> [Running; 2] {
    let controller = command_line.start_here("controller --lockstep");
    command_line.wait_for_controller();
    [controller, command_line.start_here("plant --lockstep")]
}

fn replies(stdout: &str) -> Vec<Value> {
    stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn a_stick_that_is_let_go_is_let_go_at_once() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _pair = pair(&command_line);
    let mut stream = command_line.start_here("stream --json");
    let stick = |n: u32| format!("{{\"turn_deg\":{},\"speed\":1.0{}}}\n", n % 10, n % 7);
    let lines: String = (0..5000).map(stick).collect::<String>() + "{\"turn_deg\":0,\"speed\":1}\n";
    stream.type_in(&lines);
    let ended = stream.finish();
    let replies = replies(&ended.stdout);
    assert_eq!((ended.code, replies.len()), (Some(0), 5001), "each line has its reply: {}", ended.stderr);
    let last = replies.last().unwrap();
    assert_eq!((&last["line"], &last["id"], &last["turn_deg"]), (&5001.into(), &5001.into(), &0.0.into()));
    assert!(last["lag_s"].is_number(), "{last}");
    let passed_over: Vec<&Value> = replies.iter().filter(|reply| reply["superseded_by"].is_number()).collect();
    // A line takes milliseconds to be answered, and some microseconds to be read.
    assert!(passed_over.len() > 2500, "{} of 5000 were passed over", passed_over.len());
    for reply in &passed_over {
        let by = reply["superseded_by"].as_u64().unwrap();
        assert_eq!(reply["reason"], format!("superseded by line {by}"));
        assert!(by > reply["line"].as_u64().unwrap(), "{reply}");
    }
    let told = format!("{} lines were passed over for newer ones; ", passed_over.len());
    assert!(ended.stderr.starts_with(&told), "{}", ended.stderr);
}

#[test]
fn a_stop_waits_for_no_line_before_it() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _pair = pair(&command_line);
    let mut stream = command_line.start_here("stream");
    // The pipe stays open: an end of the input must not be what sends the stop.
    stream.type_on("{\"t\":100000,\"speed\":1.1}\n{\"intent\":\"stop\"}\n");
    assert_eq!(stream.wait_for_line(), "1: superseded by line 2");
    let ended = stream.finish();
    let lines: Vec<&str> = ended.stdout.lines().collect();
    assert!(lines[1].starts_with("2: accepted: stop, from half-step "), "{lines:?}");
    assert_eq!((lines.len(), ended.code), (2, Some(0)), "{}", ended.stderr);
}

#[test]
fn lines_for_at_once_do_not_wait_for_those_with_a_time() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _pair = pair(&command_line);
    let mut stream = command_line.start_here("stream");
    stream.type_in("{\"t\":6,\"speed\":1.04}\n{\"turn_deg\":3}\n{\"t\":7,\"speed\":1.02}\n");
    let ended = stream.finish();
    let lines: Vec<&str> = ended.stdout.lines().collect();
    for (line, begin) in
        lines.iter().zip(["2: accepted: turn 3°", "1: accepted: speed 1.04", "3: accepted: speed 1.02"])
    {
        assert!(line.starts_with(begin), "{lines:?}");
    }
    assert_eq!((lines.len(), ended.code), (3, Some(0)), "{}", ended.stderr);
}
