//! What docs/import.md tells first is what a person types: its first block of commands, word for word, in a folder that
//! holds a URDF and a sole, makes a robot and walks it.

use std::fs;

use halfstep_tests::command_line::CommandLine;
use halfstep_tests::{mechanism, repository, shared};
use interchange::urdf::urdf_text;

/// Our own robot, as the program exports it: with nothing from outside.
#[test]
fn our_own_robot_walks_by_the_guides_first_commands() {
    let robot = mechanism();
    let sole = robot.sole;
    let map = format!(
        "name = \"Our own\"\n\n[sole]\nbehind_m = {}\nahead_m = {}\nwidth_m = {}\nankle_height_m = {}\n",
        sole.behind,
        sole.ahead,
        sole.inside + sole.outside,
        sole.ankle_height
    );
    follow_the_guide(&urdf_text(&robot).expect("our robot can be written"), &map, "Our own");
}

#[test]
fn a_public_robot_walks_by_the_guides_first_commands() {
    let Some(robots) = shared("robots") else { return };
    let read = |name: &str| fs::read_to_string(robots.join("g1").join(name)).expect("it is there");
    follow_the_guide(&read("robot.urdf"), &read("sole.toml"), "Unitree G1");
}

/// Types the commands in a folder that holds a URDF and a map; the robot has the map's name, and does not fall.
fn follow_the_guide(urdf: &str, map: &str, name: &str) {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for (file, text) in [("robot.urdf", urdf), ("sole.toml", map)] {
        fs::write(command_line.folder().join(file), text).expect("a new file");
    }
    let commands = first_commands();
    assert_eq!(commands.len(), 3, "{commands:?}");
    let mut said = Vec::new();
    for command in &commands {
        let words = command.strip_prefix("halfstep ").expect("a command of ours");
        let ended = command_line.run(words);
        assert_eq!(ended.code, Some(0), "{command}: {}", ended.stderr);
        said.push(ended.stdout);
    }
    assert!(said[1].contains(name), "{}", said[1]);
    assert!(said[2].contains("no fall"), "{}", said[2]);
}

/// The lines of the guide's first block of code.
fn first_commands() -> Vec<String> {
    let guide = fs::read_to_string(repository().join("docs/import.md")).expect("the guide");
    let block = guide.split("```").nth(1).expect("a block of code");
    block.trim().lines().map(str::to_owned).collect()
}
