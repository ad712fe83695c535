//! The next start cleans up after a killed process: after SIGKILL the same instance can be used again at once.

use halfstep_tests::command_line::{CommandLine, Running};

/// A controller and a plant that walk, as the controller's answer to a request shows.
fn walking(command_line: &CommandLine) -> [Running; 2] {
    let controller = command_line.start_here("controller --lockstep");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --lockstep");
    let sent = command_line.start_here("send speed 0.98").finish();
    assert_eq!(sent.code, Some(0), "{}", sent.stderr);
    [controller, plant]
}

#[test]
fn a_walk_starts_after_both_processes_were_killed() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for _ in 0..2 {
        walking(&command_line).into_iter().for_each(Running::kill);
    }
    let ended = command_line.start_here("walk --lockstep --for 2s --out after").finish();
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
}

#[test]
fn a_controller_replaces_a_killed_one_while_the_plant_waits() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let [controller, plant] = walking(&command_line);
    controller.kill();
    let nobody = command_line.start_here("send turn 1").finish();
    assert!(nobody.stderr.starts_with("no controller is running on instance"), "{}", nobody.stderr);

    // The plant still waits for the dead controller's next setpoint; the next controller takes its place.
    let next = command_line.start_here("controller --lockstep");
    command_line.wait_for_controller();
    plant.kill();
    let plant = command_line.start_here("plant --lockstep --for 1s").finish();
    assert_eq!(plant.code, Some(0), "{}", plant.stderr);
    let next = next.end();
    assert_eq!(next.code, Some(0), "{}", next.stderr);
}
