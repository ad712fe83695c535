//! Goal: when the simulated robot leaves physics, the run ends with words that name the settings to look at. What was
//! recorded is kept, and drawn as far as it is finite.

use std::fs;

use halfstep_tests::command_line::CommandLine;

/// A push that `check` takes, in a time and at a link for which no integration is made.
const PUSH: &str = "[[push]]\nat_s = 0.5\nlasts_s = 1e-6\nimpulse_n_s = [1e4, 1e4, 1e4]\nlink = \"left_forearm\"\n";

#[test]
fn an_unstable_simulation_ends_with_the_settings_to_look_at() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    fs::write(command_line.folder().join("hard.toml"), PUSH).unwrap();
    let ended = command_line.run("walk --lockstep --for 2s --disturbances hard.toml --out run");
    assert_eq!(ended.code, Some(1), "{}{}", ended.stdout, ended.stderr);
    assert!(!ended.stderr.contains("panicked"), "{}", ended.stderr);
    let says = "the simulation became unstable at ";
    let line = ended.stdout.lines().find(|line| line.starts_with(says)).expect("words");
    assert!(line.contains("look at, in config/plant.toml: the push of 17320"), "{line}");
    let replayed = command_line.run("replay run");
    assert_eq!(replayed.code, Some(0), "{}{}", replayed.stdout, replayed.stderr);
    let drawn = command_line.run("plot run");
    assert_eq!(drawn.code, Some(0), "{}", drawn.stderr);
    assert!(command_line.read("run/summary.json").contains(says));
}
