//! The robots in the box are what the importer writes: with their URDFs at hand the folders come out again, byte for
//! byte. `UPDATE_EXPECT=1` writes them anew.

use std::fs;

use halfstep_tests::{repository, shared};
use interchange::import::NamedText;
use robots::ImportedRobot;
use robots::ROBOTS;

#[test]
fn the_robots_in_the_box_are_what_the_importer_writes() {
    let Some(robots) = shared("robots") else { return };
    for robot in ROBOTS.into_iter().filter(|robot| robot.name != "paper") {
        let read = |name: &str| fs::read_to_string(robots.join(robot.name).join(name)).expect("it is there");
        let (urdf, map, source) = (read("robot.urdf"), read("sole.toml"), read("SOURCE"));
        let urdf = NamedText { text: &urdf, file: "robot.urdf" };
        let imported = ImportedRobot::new(urdf, Some(NamedText { text: &map, file: "sole.toml" }));
        let imported = imported.unwrap_or_else(|error| panic!("{}: {error}", robot.name));
        let folder = repository().join("config/robots").join(robot.name);
        for (name, text) in imported.files.into_iter().filter(|(name, _)| *name != "realtime.toml") {
            // Where the numbers come from.
            let from: String = source.lines().map(|line| format!("# {}\n", line.trim_end())).collect();
            let text =
                if name == "mechanism.toml" { format!("# Description of the robot:\n{from}{text}") } else { text };
            let file = folder.join(name);
            if std::env::var_os("UPDATE_EXPECT").is_some() {
                fs::create_dir_all(&folder).and_then(|()| fs::write(&file, &text)).expect("it can be written");
            }
            let committed = fs::read_to_string(&file).expect("it is committed");
            assert!(committed == text, "{}: is not what `halfstep import` writes", file.display());
        }
    }
}
