//! `halfstep doctor` names the first thing that is wrong with file and key, in words and in JSON.

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

#[test]
fn the_first_thing_that_is_wrong_is_named_with_its_key() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    command_line.edit("config/plant.toml", "mass_kg = 0\n", "mass_kg = 45\n");
    let ended = command_line.run("doctor --config config --json");
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    let diagnosis: Value = serde_json::from_str(&ended.stdout).expect("JSON");
    assert_eq!(diagnosis["healthy"], false);
    let checks = diagnosis["checks"].as_array().expect("a list");
    let (last, before) = checks.split_last().expect("some");
    assert!(before.iter().all(|check| check["ok"] == true), "it stops at the first one: {diagnosis:#}");
    assert_eq!(last["turn"][0]["file"], "config/plant.toml");
    assert_eq!(last["turn"][0]["key"], "payload.mass_kg");

    command_line.edit("config/plant.toml", "delay_periods = 1\n", "delay_periods = 16\n");
    let ended = command_line.run("doctor");
    assert_eq!(ended.code, Some(1));
    assert!(ended.stdout.contains("\n       turn config/plant.toml:sensors.delay_periods ("), "{}", ended.stdout);
}

#[test]
fn a_configuration_that_cannot_be_read_is_no_patient() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    command_line.edit("config/controller.toml", "gain = 3\n", "gain = \"much\"\n");
    let ended = command_line.run("doctor --json");
    assert_eq!(ended.code, Some(2));
    assert!(ended.stdout.contains("feedback.gain"), "{}", ended.stdout);
}
