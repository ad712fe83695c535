//! A stream changes the walk while it runs: each line gets its reply, what is wrong is reported with its line, and the
//! walk goes on.

use config::Config;
use halfstep_tests::command_line::CommandLine;
use plots::run_log::RunLog;

const STREAM: &str = r#"{"turn_deg":3}
nonsense
{"t":2,"speed":1.04}
{"t":3,"trun_deg":0}

{"t":1,"speed":1}
{"t":4,"turn_deg":0,"speed":9}
"#;

#[test]
fn a_stream_changes_the_walk_while_it_runs() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller --lockstep --out log");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --lockstep --out log");
    let mut stream = command_line.start_here("stream");
    stream.type_in(STREAM);
    let ended = stream.finish();

    // The replies, in order, and the complaints.
    assert_eq!(ended.code, Some(1), "some lines were wrong");
    let replies: Vec<&str> = ended.stdout.lines().collect();
    assert_eq!(replies.len(), 3, "{replies:?}");
    assert!(replies[0].starts_with("1: accepted: turn 3°, from half-step "), "{replies:?}");
    assert!(replies[1].starts_with("3: accepted: speed 1.04, from half-step "), "{replies:?}");
    let limits =
        controller::Parameters::load(command_line.folder().join("config/controller.toml")).unwrap().gait.limits;
    let limited = format!("7: limited to turn 0°, speed {}, from half-step ", limits.speed_max);
    assert!(replies[2].starts_with(&limited), "{replies:?}");
    let complaints: Vec<&str> = ended.stderr.lines().collect();
    assert_eq!(complaints.len(), 3, "{complaints:?}");
    assert!(complaints[0].starts_with("stdin:2: not a JSON object; write e.g. {"), "{complaints:?}");
    assert!(complaints[1].starts_with("stdin:4: unknown field `trun_deg`, expected one of `t`"), "{complaints:?}");
    assert!(complaints[2].starts_with("stdin:6: t = 1: must not be less than 2"), "{complaints:?}");

    // The walk.
    for (process, name) in [(plant, "plant"), (controller, "controller")] {
        let ended = process.end();
        assert_eq!(ended.code, Some(0), "the {name} walked to its end: {}", ended.stderr);
    }
    let log = RunLog::read(&command_line.folder().join("log")).unwrap();
    assert_eq!(log.falls().count(), 0);
    let commands: Vec<[f64; 2]> = log.controller.iter().map(|row| [row.turn_command, row.speed_command]).collect();
    let mut changes = commands.chunk_by(|before, after| before == after).map(|chunk| chunk[0]);
    let turned = [3_f64.to_radians(), 1.0];
    assert!(changes.any(|change| (change[0] - turned[0]).abs() < 1e-12 && change[1] == 1.0), "it turned");
    assert_eq!(changes.next().map(|[_, speed]| speed), Some(1.04), "then it went faster");
    assert_eq!(changes.next_back(), Some([0.0, limits.speed_max]), "at last straight on, as fast as it may");
}

#[test]
fn a_stream_answers_each_line_before_the_next_one() {
    // The pipe stays open: the reply must not wait for more lines.
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _controller = command_line.start_here("controller --lockstep");
    command_line.wait_for_controller();
    let _plant = command_line.start_here("plant --lockstep");
    let mut stream = command_line.start_here("stream --json");
    stream.type_on("{\"speed\":0.97}\n");
    let reply: serde_json::Value = serde_json::from_str(&stream.wait_for_line()).unwrap();
    assert_eq!((&reply["line"], &reply["verdict"]), (&1.into(), &"accepted".into()));
    assert_eq!(reply["speed"], 0.97);
    assert_eq!(stream.finish().code, Some(0));
}
