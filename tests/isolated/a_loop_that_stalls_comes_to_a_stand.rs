//! A controller that has missed many deadlines in a row does not walk on as if nothing had been; a few are made up for.
//!
//! Method: the system halts the controller's process for a while. How long it really was halted nobody promises, so
//! that only the least is relied on.

use std::time::Duration;

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

use crate::alone;

/// Walks for three seconds, halts the controller for some of it, and gives its summary.
fn halted(command_line: &CommandLine, halt: Duration) -> Value {
    let controller = command_line.start_here("controller --for 3s --out run --json");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --for 3s");
    std::thread::sleep(Duration::from_millis(700));
    controller.halt_for(halt);
    let ended = controller.finish();
    plant.end();
    serde_json::from_str(&ended.stdout).unwrap_or_else(|error| panic!("{error}: {}", ended.stderr))
}

#[test]
fn a_loop_that_stalls_comes_to_a_stand_and_one_late_for_a_moment_walks_on() {
    let _alone = alone();
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    command_line.edit("config/realtime.toml", "hold_after_misses = 250", "hold_after_misses = 40");
    let summary = halted(&command_line, Duration::from_millis(80));
    assert!(summary["deadline_misses"].as_u64().unwrap() >= 40, "{summary}");
    assert_ne!(summary["mode"], "walking", "{summary}");
    if summary["log_gaps"] == 0 {
        // What the loop asked by itself is in the recording, too.
        assert_eq!(command_line.run("replay run").code, Some(0));
    }

    command_line.edit("config/realtime.toml", "hold_after_misses = 40", "hold_after_misses = 0");
    let summary = halted(&command_line, Duration::from_millis(30));
    assert!(summary["deadline_misses"].as_u64().unwrap() > 0, "{summary}");
    assert_eq!(summary["mode"], "walking", "{summary}");
}

#[test]
fn a_side_that_is_halted_for_two_seconds_ends_in_a_stand_or_in_a_fall_that_is_noticed() {
    let _alone = alone();
    for halted in ["controller", "plant"] {
        let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
        let controller = command_line.start_here("controller --for 6s --json");
        command_line.wait_for_controller();
        let plant = command_line.start_here("plant --for 6s --json");
        std::thread::sleep(Duration::from_millis(700));
        (if halted == "controller" { &controller } else { &plant }).halt_for(Duration::from_secs(2));
        let [plant, controller] = [plant, controller].map(|process| {
            let ended = process.finish();
            serde_json::from_str::<Value>(&ended.stdout).unwrap_or_else(|error| panic!("{error}: {}", ended.stderr))
        });
        let mode = controller["mode"].as_str().unwrap();
        if plant["fell_at_s"].is_null() {
            assert_ne!(mode, "walking", "{halted}: {controller} {plant}");
        } else {
            assert!(["fallen", "faulted"].contains(&mode), "{halted}: {controller} {plant}");
        }
    }
}
