//! Two processes walk in lockstep: they do not fall, and what they do depends on nothing but seed and commands.
//!
//! The same walk twice must leave the same truth about the plant to the byte; another seed another one, so that the
//! comparison can fail.

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

/// Walks for six seconds into `folder` and gives the summary without what the clock on the wall has a say in.
fn walk(command_line: &CommandLine, folder: &str, seed: u64) -> Value {
    let ended = command_line.run(&format!("walk --lockstep --for 6s --seed {seed} --out {folder} --json"));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let mut summary: Value = serde_json::from_str(&command_line.read(&format!("{folder}/summary.json"))).unwrap();
    let mut printed: Value = serde_json::from_str(&ended.stdout).unwrap();
    assert_eq!(printed.as_object_mut().unwrap().remove("folder"), Some(folder.into()));
    assert_eq!(summary, printed, "stdout and summary.json say the same");
    for of_the_wall in ["real_time_factor", "instance"] {
        assert!(summary.as_object_mut().unwrap().remove(of_the_wall).is_some());
    }
    summary
}

#[test]
fn a_lockstep_walk_depends_on_seed_and_commands_only() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let summary = walk(&command_line, "first", 3);
    assert_eq!(summary["falls"], 0);
    assert_eq!(summary["half_steps"], 10, "T is 0.6 s, and the walk is a little faster at last");
    assert_eq!(summary["requests"]["accepted"], 2, "the built-in script turns at 2 s and hurries at 5.5 s");
    let distance = summary["distance_m"].as_f64().unwrap();
    assert!((2.0..3.0).contains(&distance), "ten half-steps of 0.25 m, not {distance} m");

    assert_eq!(walk(&command_line, "again", 3), summary);
    let log = |folder: &str| command_line.csv(folder, "plant");
    assert!(log("again") == log("first"), "the same walk leaves the same log");

    walk(&command_line, "other", 4);
    assert!(log("other") != log("first"), "another seed senses otherwise");
}

#[test]
fn a_walk_draws_every_picture() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let ended = command_line.run("walk --lockstep --for 3s");
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(ended.stdout.contains("runs/0001"), "it says where they are: {}", ended.stdout);
    let over_time = ["balance_over_time", "margin_over_time", "compensation_over_time", "zmp_over_time"];
    let drives = ["joints_over_time", "joint_errors_over_time", "torques_over_time", "currents_over_time"];
    let pictures = over_time.into_iter().chain(drives).chain(["footprints", "zmp_in_sole", "stick_walk"]);
    let page = command_line.read("runs/0001/index.html");
    for picture in pictures {
        let text = command_line.read(&format!("runs/0001/{picture}.svg"));
        assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"), "{picture}.svg");
        assert!(page.contains(&format!("<figure id=\"{picture}.svg\">")), "{picture} is on the page");
    }
    assert!(page.contains("controller.toml") && page.contains("least margin") && page.contains("cost of transport"));
}
