//! A fault that stops a walk is named with its time: in the summary, in the replies to later requests, in the
//! controller's last line, and when it happens. Such a walk ends with exit code 1.

use std::fs;

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

/// No measurement for 0.3 s: longer than the controller bridges.
const DROP_OUT: &str = "[[sensor_fault]]\nat_s = 2.2\nlasts_s = 0.3\nkind = \"drop_out\"\n";
const COMMANDS: &str = "{\"t\":0.1,\"intent\":\"walk\"}\n{\"t\":5,\"turn_deg\":5}\n";
const FAULT: &str = "no valid measurement has arrived for too long";

#[test]
fn a_fault_that_stops_a_walk_is_named_with_its_time() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    fs::write(command_line.folder().join("drop_out.toml"), DROP_OUT).unwrap();
    fs::write(command_line.folder().join("commands.jsonl"), COMMANDS).unwrap();
    let walk = "walk --lockstep --for 6s --commands commands.jsonl --disturbances drop_out.toml --out";

    let ended = command_line.run(&format!("{walk} text"));
    assert_eq!(ended.code, Some(1), "it did not walk as it was asked to: {}", ended.stdout);
    let lines: Vec<&str> = ended.stdout.lines().collect();
    assert!(lines[0].ends_with("no fall, stopped by a fault"), "{lines:?}");
    let named = format!("fault at 2.30 s: {FAULT}; at the end faulted");
    assert_eq!(lines[1], named, "{lines:?}");
    let told = format!("controller: fault at 2.30 s: {FAULT}; when that is mended: `halfstep send --instance walk-");
    assert!(ended.stderr.lines().any(|line| line.starts_with(&told)), "{}", ended.stderr);
    let refusal = format!("at 5.00 s, turn 5°: refused: a fault is latched: send reset ({FAULT}, since 2.30 s)");
    assert!(ended.stderr.lines().any(|line| line == refusal), "{}", ended.stderr);

    let ended = command_line.run(&format!("{walk} json --json"));
    let mut printed: Value = serde_json::from_str(&ended.stdout).unwrap();
    let written: Value = serde_json::from_str(&command_line.read("json/summary.json")).unwrap();
    let folder = printed.as_object_mut().unwrap().remove("folder");
    assert_eq!((&printed, ended.code, folder), (&written, Some(1), Some("json".into())));
    let fault = serde_json::json!({"fault": FAULT, "time_s": 2.3});
    assert_eq!((&printed["fault"], &printed["mode"]), (&fault, &"faulted".into()));
}

#[test]
fn a_controller_tells_its_modes_and_ends_with_the_fault() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    fs::write(command_line.folder().join("drop_out.toml"), DROP_OUT).unwrap();
    let controller = command_line.start_here("controller --lockstep --for 6s");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --lockstep --for 6s --disturbances drop_out.toml");
    let (plant, controller) = (plant.finish(), controller.finish());
    assert_eq!((plant.code, controller.code), (Some(0), Some(1)), "{}", controller.stderr);
    let told: Vec<&str> = controller.stderr.lines().collect();
    let waits = format!("controller: waits for the plant on instance `{}`", command_line.instance());
    assert_eq!(told[..2], [&*waits, "controller: walking at 0.00 s"]);
    assert!(told.last().unwrap().starts_with("controller: faulted at "), "{told:?}");
    assert!(controller.stdout.contains(&format!("faulted (fault at 2.30 s: {FAULT}); ")), "{}", controller.stdout);
    let waits = format!("plant: waits for the controller on instance `{}`", command_line.instance());
    assert_eq!(plant.stderr.lines().collect::<Vec<_>>(), [&*waits, "plant: follows the controller"]);
}
