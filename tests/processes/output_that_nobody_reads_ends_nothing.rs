//! What cannot be written to stdout or stderr is lost, and nothing else: no command panics, no walk or stream ends.

use std::fs::{self, File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::process::Stdio;

use halfstep_tests::command_line::CommandLine;

/// A file that is always full.
fn full() -> Stdio {
    OpenOptions::new().write(true).open("/dev/full").expect("Linux has it").into()
}

/// A pipe whose reader has gone.
fn closed() -> Stdio {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    writer.into()
}

/// Every command, most of them with a mistake that is soon found.
const COMMANDS: &[&str] = &[
    "walk --lockstep --for 1s --out OUT --commands limited.jsonl",
    "controller --lockstep --for 1s --parent 1",
    "plant --config nowhere",
    "send --instance nobody stop",
    "stream --instance nobody nowhere.jsonl",
    "check",
    "check --config nowhere",
    "export urdf",
    "export mjcf",
    "plot nowhere",
    "replay nowhere",
    "paper --figure one",
    "synthesize --step-length -1 --out half_step.csv",
    "import nowhere.urdf --map nowhere.toml --out robot",
    "bench --config nowhere compute",
    "--help",
    "wlak",
];

#[test]
fn no_command_panics_when_its_output_cannot_be_written() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let limited = "{\"t\":0.1,\"speed\":9}\n".repeat(20);
    fs::write(command_line.folder().join("limited.jsonl"), limited).unwrap();
    for (number, words) in COMMANDS.iter().enumerate() {
        let code = command_line.run(&words.replace("OUT", &format!("run-{number}"))).code;
        for (name, output) in [("full", full as fn() -> Stdio), ("closed", closed)] {
            let words = words.replace("OUT", &format!("{name}-{number}"));
            let log = File::create(command_line.folder().join("log")).unwrap();
            let mut child = command_line.spawn(&words, log.into(), output());
            let status = child.wait().unwrap();
            assert_eq!(status.code(), code, "halfstep {words}, stderr {name}");

            let words = words.replace(name, &format!("out-{name}"));
            let log = File::create(command_line.folder().join("log")).unwrap();
            let mut child = command_line.spawn(&words, output(), log.into());
            let status = child.wait().unwrap();
            let stderr = command_line.read("log");
            assert!(!stderr.contains("panicked"), "halfstep {words}, stdout {name}: {stderr}");
            // A reader that has closed the pipe has read enough; a full disk is an error.
            let is_told = code == Some(0) && name == "full" && words != "--help";
            assert_eq!(
                status.code(),
                if is_told { Some(1) } else { code },
                "halfstep {words}, stdout {name}: {stderr}"
            );
            assert_eq!(stderr.contains("cannot print: No space left on device"), is_told, "{words}: {stderr}");
            assert!(!stderr.contains("Broken pipe"), "halfstep {words}: {stderr}");
        }
    }
}

#[test]
fn a_walk_that_nobody_reads_is_recorded_and_plotted() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let mut child = command_line.spawn("walk --lockstep --for 2s --out walked", closed(), closed());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    for file in ["run.mcap", "summary.json", "footprints.svg"] {
        assert!(command_line.folder().join("walked").join(file).exists(), "{file}");
    }
}

#[test]
fn a_stream_goes_on_when_nobody_reads_its_replies() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller --lockstep --out log");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --lockstep --out log");
    let words = format!("stream --instance {}", command_line.instance());
    let mut stream = command_line.spawn(&words, Stdio::piped(), closed());
    let mut pipe = stream.stdin.take().unwrap();
    let mut replies = BufReader::new(stream.stdout.take().unwrap());
    pipe.write_all(b"{\"turn_deg\":3}\n").unwrap();
    let mut line = String::new();
    replies.read_line(&mut line).unwrap();
    assert!(line.starts_with("1: accepted"), "{line}");
    // As `| head -n 1` does.
    drop(replies);
    pipe.write_all(b"nonsense\n{\"t\":3,\"turn_deg\":4}\n{\"t\":4,\"turn_deg\":0,\"speed\":1.05}\n").unwrap();
    drop(pipe);
    assert_eq!(stream.wait().unwrap().code(), Some(1), "one line was wrong, which is all");
    plant.end();
    controller.end();
    let log = plots::run_log::RunLog::read(&command_line.folder().join("log")).unwrap();
    assert_eq!(log.controller.last().map(|row| row.speed_command), Some(1.05), "the last line was heard");
}
