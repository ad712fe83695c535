//! Away from the repository, the program has all that it needs, and names no file that the user did not.

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

#[test]
fn the_paper_is_reproduced_without_its_files() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    std::fs::remove_dir_all(command_line.folder().join("config")).expect("the folder of the tests");
    let ended = command_line.run("paper --json");
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let figures: Vec<Value> = serde_json::from_str(&ended.stdout).expect("JSON");
    assert_eq!(figures.len(), 45);
    let urdf = command_line.run("export urdf --robot g1");
    assert!(urdf.code == Some(0) && urdf.stdout.contains("<robot name="), "{}", urdf.stderr);
    let synthesized = command_line.run("synthesize");
    assert_eq!(synthesized.code, Some(2));
    assert!(
        synthesized.stderr.starts_with("config/mechanism.toml: does not exist; name the robot's file with --mechanism"),
        "{}",
        synthesized.stderr
    );
}

#[test]
fn options_of_a_benchmark_may_stand_behind_its_name() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for words in ["bench --robot nobody compute", "bench compute --robot nobody"] {
        let ended = command_line.run(words);
        assert_eq!(ended.code, Some(2), "{words}");
        assert!(ended.stderr.contains("must be one of paper, g1,"), "{}", ended.stderr);
    }
}
