//! What was recorded stays: no later run overwrites it, and no interrupted merge hides it.

use std::fs;

use halfstep_tests::command_line::CommandLine;

fn command_line() -> CommandLine {
    CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"))
}

fn names(command_line: &CommandLine, folder: &str) -> Vec<String> {
    let files = fs::read_dir(command_line.folder().join(folder)).unwrap().flatten();
    let mut names: Vec<String> = files.map(|file| file.file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| name.ends_with(".mcap") || name.contains("unfinished"));
    names.sort();
    names
}

#[test]
fn a_walk_into_the_folder_of_another_run_sets_that_aside() {
    let command_line = command_line();
    assert_eq!(command_line.run("walk --lockstep --for 1s --out run").code, Some(0));
    let before = fs::read(command_line.folder().join("run/run.mcap")).unwrap();
    for (seed, aside) in [(1, "run-1"), (2, "run-2")] {
        let ended = command_line.run(&format!("walk --lockstep --for 1s --seed {seed} --out run"));
        assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        assert!(ended.stderr.contains(&format!("run: held an earlier run, which is in {aside} now\n")));
        assert_ne!(fs::read(command_line.folder().join("run/run.mcap")).unwrap(), before);
        assert!(command_line.run(&format!("replay {aside}")).stdout.starts_with("identical"), "{aside}");
    }
    assert_eq!(fs::read(command_line.folder().join("run-1/run.mcap")).unwrap(), before);
}

#[test]
fn a_walk_into_the_folder_of_a_run_that_goes_on_is_refused() {
    let command_line = command_line();
    let controller = command_line.start_here("controller --out run");
    command_line.wait_for_controller();
    let ended = command_line.run("walk --lockstep --for 1s --out run");
    assert_ne!(ended.code, Some(0));
    assert!(ended.stderr.contains("run/controller.mcap"), "{}", ended.stderr);
    controller.end();
}

#[test]
fn a_controller_that_is_started_again_keeps_the_recording_of_the_one_before() {
    let command_line = command_line();
    for _ in 0..3 {
        let controller = command_line.start_here("controller --lockstep --for 200ms --out run");
        command_line.wait_for_controller();
        let plant = command_line.start_here("plant --lockstep --for 200ms --out run").finish();
        assert_eq!((controller.finish().code, plant.code), (Some(0), Some(0)));
    }
    let recorded = ["controller-1.mcap", "controller-2.mcap", "controller.mcap"];
    assert_eq!(names(&command_line, "run")[..3], recorded);
    for file in recorded {
        let replayed = command_line.run(&format!("plot run/{file} --out pictures"));
        assert!(!replayed.stderr.contains("truncated"), "{file}: {}", replayed.stderr);
    }
    let replayed = command_line.run("replay run");
    assert_eq!(replayed.stdout, "identical: 200 setpoints\n", "{}", replayed.stderr);
}

#[test]
fn an_interrupted_merge_hides_nothing() {
    let command_line = command_line();
    let controller = command_line.start_here("controller --lockstep --for 1s --out run");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --lockstep --for 1s --out run").finish();
    assert_eq!((controller.finish().code, plant.code), (Some(0), Some(0)));
    // As older versions left it: the merged recording is there, cut.
    let part = fs::read(command_line.folder().join("run/controller.mcap")).unwrap();
    fs::write(command_line.folder().join("run/run.mcap"), &part[..part.len() / 3]).unwrap();
    let replayed = command_line.run("replay run");
    assert_eq!(replayed.stdout, "identical: 1000 setpoints\n", "{}", replayed.stderr);
}
