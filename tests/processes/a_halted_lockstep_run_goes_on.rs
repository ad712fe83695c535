//! A lockstep run that is halted goes on as if nothing had been, whichever side was halted.

use std::time::Duration;

use halfstep_tests::command_line::CommandLine;

#[test]
fn halting_either_side_changes_no_bit() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let run = |out: &str, halts: bool| {
        let controller = command_line.start_here(&format!("controller --lockstep --for 3s --out {out}"));
        command_line.wait_for_controller();
        let plant = command_line.start_here(&format!("plant --lockstep --for 3s --out {out}"));
        if halts {
            plant.halt_for(Duration::from_millis(300));
            controller.halt_for(Duration::from_millis(300));
        }
        for ended in [plant.finish(), controller.finish()] {
            assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        }
        command_line.csv(out, "plant")
    };
    assert!(run("first", false) == run("halted", true), "the logs differ");
}
