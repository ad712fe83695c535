//! Controller and plant that do not fit are not let together: clock and start posture are refused with both values.

use halfstep_tests::command_line::CommandLine;

#[test]
fn another_clock_or_start_posture_is_refused_with_both_values() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for (controller, plant, says) in [
        ("--lockstep", "", "has clock lockstep, this process has clock realtime; start both sides with --lockstep"),
        ("", "--lockstep", "has clock realtime, this process has clock lockstep; start both sides with --lockstep"),
        ("--lockstep --from-stand", "--lockstep", "has start stand, this process has start stride; start both"),
        ("--lockstep", "--lockstep --from-stand", "has start stride, this process has start stand; start both"),
    ] {
        let first = command_line.start_here(&format!("controller {controller}"));
        command_line.wait_for_controller();
        let second = command_line.start_here(&format!("plant {plant} --for 1s")).finish();
        assert_eq!(second.code, Some(1), "{controller}/{plant}: {}", second.stdout);
        assert!(second.stderr.contains(says), "{controller}/{plant}: {}", second.stderr);
        first.end();
    }
}
