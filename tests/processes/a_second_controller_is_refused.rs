//! A second controller on the same instance is refused with a clear message, and does not disturb the first.

use halfstep_tests::command_line::CommandLine;

#[test]
fn a_second_controller_is_refused() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let first = command_line.start_here("controller --lockstep --for 2s");
    command_line.wait_for_controller();

    let second = command_line.start_here("controller --lockstep --for 2s").finish();
    assert_eq!(second.code, Some(1));
    assert_eq!(second.stdout, "");
    let says = "another controller is already running on instance `test-";
    assert!(second.stderr.starts_with(says), "{}", second.stderr);
    assert_eq!(second.stderr.lines().count(), 1, "{}", second.stderr);

    let plant = command_line.start_here("plant --lockstep --for 2s").finish();
    assert_eq!(plant.code, Some(0), "{}", plant.stderr);
    let first = first.finish();
    assert_eq!(first.code, Some(0), "{}", first.stderr);
    assert!(first.stdout.starts_with("2000 ticks, 3 half-steps, walking"), "{}", first.stdout);
}

#[test]
fn send_and_stream_fail_without_a_controller() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for words in ["send turn 5", "stream"] {
        let ended = command_line.start_here(words).finish();
        assert_eq!(ended.code, Some(1));
        assert!(ended.stderr.starts_with("no controller is running on instance `test-"), "{}", ended.stderr);
    }
}
