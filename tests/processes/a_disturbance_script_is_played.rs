//! Goal: what a script of disturbances says happens to both processes' robot; a script with a mistake is refused, and
//! the message names file, line, key, value and what would be right.

use config::Config;
use halfstep_tests::command_line::CommandLine;
use halfstep_tests::repository;
use model::Joint;
use nalgebra::Vector3;
use plant::{Disturbances, Push};
use serde_json::Value;

const GOOD: &str = r#"[[push]]
at_s = 1
lasts_s = 0.1
impulse_n_s = [0, 4, 0]
link = "pelvis"

[[sensor_fault]]
at_s = 2
lasts_s = 0.01
kind = "spike"
values = "angles"
joint = "left_knee"
size_deg = 90

[[sensor_fault]]
at_s = 3
lasts_s = 0.01
kind = "delay"
delay_periods = 3
"#;

fn complaint(text: &str) -> String {
    Disturbances::from_toml(text, "script.toml").map_or_else(|errors| errors.to_string(), |_| String::new())
}

#[test]
fn a_good_disturbance_script_is_read() {
    let read = Disturbances::from_toml(GOOD, "script.toml").unwrap();
    let push = Push { link: Joint::RightHipRoll, impulse: Vector3::new(0.0, 4.0, 0.0), start: 1.0, duration: 0.1 };
    assert_eq!((read.pushes, read.sensor_faults.len()), (vec![push], 2));
    assert_eq!(Disturbances::from_toml("", "script.toml"), Ok(Disturbances::default()));
    let demo =
        Disturbances::load(repository().join("config/disturbances_demo.toml")).expect("the committed script loads");
    assert_eq!((demo.pushes.len(), demo.sensor_faults.len()), (2, 5));
}

#[test]
fn each_mistake_of_a_disturbance_script_is_named() {
    for (good, bad, expected) in [
        ("at_s = 1", "at_s = -1", "script.toml:2:8: push[0].at_s = -1: must lie between 0 and 1000000"),
        (
            "lasts_s = 0.1",
            "lasts_s = 0",
            "script.toml:3:11: push[0].lasts_s = 0: must lie between 0.000001 and 1000000",
        ),
        ("lasts_s = 0.1", "lasts_ms = 100", "push[0].lasts_ms = 100: unknown key; write `lasts_s`"),
        ("[0, 4, 0]", "[0, 4]", "push[0].impulse_n_s = [0, 4]: must be an array of 3 finite numbers"),
        ("[0, 4, 0]", "[0, 4e9, 0]", "push[0].impulse_n_s = [0, 4e9, 0]: each must lie between -10000 and 10000"),
        ("\"pelvis\"", "\"hip\"", "push[0].link = \"hip\": must be one of \"right_foot\", \"right_shank\""),
        ("[[push]]", "[push]", "must be tables, each with the header [[push]]"),
        ("[[push]]", "[[pusch]]", "pusch = [[pusch]]: unknown key; write `push`"),
        ("\"spike\"", "\"spik\"", "sensor_fault[0].kind = \"spik\": must be one of \"freeze\", \"nan\", \"missing\""),
        (
            "\"angles\"",
            "\"angle\"",
            "sensor_fault[0].values = \"angle\": must be one of \"all\", \"angles\", \"rates\"",
        ),
        ("\"left_knee\"", "\"knee\"", "sensor_fault[0].joint = \"knee\": must be one of \"foot_roll\""),
        ("size_deg = 90", "size_n = 90", "sensor_fault[0].size_n = 90: unknown key; write `size_deg`"),
        (
            "values = \"angles\"\njoint = \"left_knee\"",
            "",
            "sensor_fault[0].values: must say which values have the size: \"all\" have no unit in common",
        ),
        ("delay_periods = 3", "delay_periods = 99", "must be a whole number between 1 and 31"),
        ("delay_periods = 3", "", "sensor_fault[1].delay_periods: is missing"),
        ("\"delay\"", "\"drop_out\"", "sensor_fault[1].delay_periods = 3: unknown key"),
    ] {
        assert!(GOOD.contains(good), "{good}");
        let found = complaint(&GOOD.replace(good, bad));
        assert!(found.contains(expected), "{bad}: says `{found}` instead of `{expected}`");
    }
}

#[test]
fn a_bad_disturbance_script_is_refused_before_anything_starts() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    command_line.edit("config/disturbances_demo.toml", "\"freeze\"", "\"frieze\"");
    for words in ["walk --for 1s", "plant --for 1s", "check"] {
        let script = if words == "check" { "" } else { "--disturbances config/disturbances_demo.toml" };
        let ended = command_line.run(&format!("{words} {script}"));
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{words}");
        assert!(ended.stderr.starts_with("config/disturbances_demo.toml:"), "{words}: {}", ended.stderr);
        assert_eq!(ended.stderr.lines().count(), 1, "{words}: {}", ended.stderr);
    }
    assert_eq!(command_line.run("walk --for 1s --disturbances none.toml").code, Some(2));
}

/// Pushed over, and not; with the samples dropped out for longer than the controller bears.
#[test]
fn a_disturbance_script_disturbs_two_processes_alike() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let walk = |folder: &str, script: &str| {
        std::fs::write(command_line.folder().join("script.toml"), script).unwrap();
        let words = format!("walk --lockstep --for 3s --out {folder} --disturbances script.toml --json");
        let ended = command_line.run(&words);
        let summary: Value = serde_json::from_str(&ended.stdout).unwrap_or_else(|_| panic!("{}", ended.stderr));
        (ended.code, summary["falls"].as_u64().unwrap())
    };
    let log = |folder: &str, file: &str| command_line.csv(folder, file);

    assert_eq!(walk("quiet", ""), (Some(0), 0));
    let push = "[[push]]\nat_s = 1\nlasts_s = 0.1\nimpulse_n_s = [0, 60, 0]";
    assert_eq!(walk("pushed", push), (Some(1), 1));
    assert!(log("pushed", "plant") != log("quiet", "plant"));

    let stale = |folder: &str| {
        let log = log(folder, "controller");
        let faults = log.lines().next().unwrap().split(',').position(|column| column == "faults").unwrap();
        let bit = interface::Fault::MeasurementStale as u32;
        let is_stale = |row: &&str| row.split(',').nth(faults).unwrap().parse::<u32>().unwrap() & bit != 0;
        log.lines().skip(1).filter(is_stale).count()
    };
    assert_eq!(stale("quiet"), 0);
    walk("dropped", "[[sensor_fault]]\nat_s = 1\nlasts_s = 0.3\nkind = \"drop_out\"");
    assert!((190..210).contains(&stale("dropped")), "of 300 ms, 100 ms are borne: {}", stale("dropped"));
}
