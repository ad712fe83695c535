//! `send` waits a moment for a controller that is just starting; if there is none it says which instances have one, and
//! leaves nothing behind.

use std::fs;

use halfstep_tests::command_line::CommandLine;
use wire::Instance;

#[test]
fn send_waits_for_a_controller_that_is_just_starting() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let send = command_line.start_here("send speed 1.1");
    let _controller = command_line.start_here("controller --lockstep");
    let _plant = command_line.start_here("plant --lockstep");
    let ended = send.finish();
    assert!(ended.stdout.starts_with("accepted: speed 1.1"), "{}{}", ended.stdout, ended.stderr);
}

#[test]
fn a_mistyped_instance_is_refused_with_those_that_run_and_leaves_no_files() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _controller = command_line.start_here("controller --lockstep");
    command_line.wait_for_controller();
    let mistyped = format!("{}x", command_line.instance());
    let ended = command_line.run(&format!("send --instance {mistyped} stop"));
    assert_eq!(ended.code, Some(1));
    assert!(ended.stderr.contains(&format!("--instance {}", command_line.instance())), "{}", ended.stderr);
    let instance = Instance::new(&mistyped).unwrap();
    assert!(!instance.folder().exists(), "{}", instance.folder().display());
    let prefix = instance.prefix();
    let left: Vec<_> = fs::read_dir("/dev/shm").unwrap().flatten().map(|file| file.file_name()).collect();
    assert!(!left.iter().any(|name| name.to_string_lossy().starts_with(&prefix)), "{left:?}");
}

#[test]
fn an_error_is_json_if_the_result_would_be() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for (words, code, begin) in [
        ("send --json --instance a/b stop", 2, "error: invalid value 'a/b' for '--instance <NAME>'"),
        ("send --json turn left", 2, "error: invalid value 'left' for '<DEGREES>': must be a number, e.g. 10 or -2.5"),
        ("check --json --config nowhere", 2, "nowhere/mechanism.toml: cannot be read"),
        ("export --json urdf --mechanism nowhere.toml", 2, "nowhere.toml: cannot be read"),
        ("walk --json --for -5s", 2, "error: invalid value '-5s' for '--for <DURATION>': must not be negative"),
    ] {
        let ended = command_line.run(words);
        let json: serde_json::Value =
            serde_json::from_str(&ended.stdout).unwrap_or_else(|error| panic!("{words}: {error}"));
        assert!(json["error"].as_str().unwrap().starts_with(begin), "{words}: {json}");
        assert_eq!(ended.code, Some(code), "{words}");
        assert!(ended.stderr.starts_with(begin), "{words}: {}", ended.stderr);
    }
    let exported = command_line.run("export --json urdf --out robot.urdf");
    assert_eq!(exported.stdout, "{\"file\":\"robot.urdf\"}\n");
}

#[test]
fn a_folder_may_begin_with_a_hyphen() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let ended = command_line.run("walk --lockstep --for 1s --out=-x");
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(command_line.folder().join("-x/run.mcap").exists());
    assert!(ended.stdout.starts_with("1 half-step in 1.0 s: "), "{}", ended.stdout);
}
