//! A script with more lines than can wait at a time gives the same bits in lockstep, whatever delays its sender.

use std::fmt::Write;
use std::fs;
use std::time::Duration;

use halfstep_tests::command_line::CommandLine;

#[test]
fn a_long_script_gives_the_same_bits_when_its_sender_is_halted() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let mut script = String::new();
    for line in 0..300 {
        // Dense at first, many for one tick, and one without a time.
        let time = if line < 100 { 0.5 } else { 0.5 + 0.01 * f64::from(line - 100) };
        writeln!(script, "{{\"t\":{time},\"speed\":{}}}", 1.0 + 0.05 * f64::from(line % 2)).unwrap();
    }
    script += "{\"turn_deg\":3}\n";
    fs::write(command_line.folder().join("long.jsonl"), script).unwrap();

    let walk = |out: &str| command_line.start(&format!("walk --lockstep --for 3s --commands long.jsonl --out {out}"));
    let first = walk("first").finish();
    assert_eq!(first.code, Some(0), "{}", first.stderr);
    let mut halted = walk("halted");
    for _ in 0..20 {
        if halted.is_running() {
            halted.halt_for(Duration::from_millis(30));
            std::thread::sleep(Duration::from_millis(15));
        }
    }
    let halted = halted.finish();
    assert_eq!(halted.code, Some(0), "{}", halted.stderr);
    // The controller's table tells how long each tick took, which is never the same.
    assert!(command_line.csv("first", "plant") == command_line.csv("halted", "plant"), "the walks differ");
    assert!(first.stdout.contains("requests: "), "{}", first.stdout);
    let requests = |stdout: &str| stdout.lines().find(|line| line.starts_with("requests: ")).map(str::to_owned);
    assert_eq!(requests(&first.stdout), requests(&halted.stdout));
}

/// A stop overtakes requests that arrive with it, and that of a script says that none follows.
#[test]
fn a_script_that_ends_with_a_stop_is_not_waited_for() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for (name, stop) in [("intent", r#""intent":"stop""#), ("velocity", r#""vx":0"#)] {
        let script = format!("{{\"t\":0.5,\"vx\":0.3}}\n{{\"t\":1.0,\"vx\":0.2}}\n{{\"t\":1.5,{stop}}}\n");
        fs::write(command_line.folder().join("stopped.jsonl"), script).unwrap();
        let walk = format!("walk --lockstep --for 3s --commands stopped.jsonl --out {name}");
        let run = command_line.start(&walk).finish();
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(run.stdout.contains("requests: 3 accepted"), "{}", run.stdout);
    }
}
