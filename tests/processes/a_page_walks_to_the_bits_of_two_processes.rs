//! Goal: a walk that a page walks by itself, in one thread, commands the bits that two processes command in lockstep
//! for the same robot, seed, commands and pushes.

use std::fs;

use halfstep_tests::command_line::CommandLine;
use serde_json::{Value, json};
use web::PageWalk;

/// What the page says when so many periods have been walked.
const SAID: [(u64, &str); 4] = [
    (2345, r#"{"command": {"turn_deg": 15, "speed": 1.1}}"#),
    (6010, r#"{"push": {"joint": 15, "impulse": [4, 3, 0], "lasts_s": 0.1}}"#),
    (9000, r#"{"command": {"vx": -0.1, "vy": 0.05}}"#),
    (13_000, r#""stop""#),
];
const SECONDS: u64 = 18;

/// What the page is told at the end of the walk.
fn walked_by_a_page(robot: &str, seed: u64) -> Value {
    let beginning = json!({ "robot": { "in_the_box": robot }, "seed": seed });
    let mut page = PageWalk::begin(&serde_json::from_value(beginning).expect("a beginning")).expect("it can walk");
    let end = SECONDS * 1000;
    for (tick, text) in SAID.into_iter().chain([(end, "\"beat\"")]) {
        page.walk_on(u32::try_from(tick - page.walk().tick()).expect("not many"));
        page.hear(&serde_json::from_str(text).expect("a message"));
    }
    let news = page.take_news().into_iter().map(|text| serde_json::from_str::<Value>(&text).expect("JSON"));
    news.rev().find_map(|mut message| message.as_object_mut()?.remove("walked")).expect("it has walked")
}

#[test]
fn a_page_walks_to_the_bits_of_two_processes() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for (robot, seed) in [("paper", 3), ("t1", 0)] {
        let by_page = walked_by_a_page(robot, seed);
        for (file, key) in [("my.jsonl", "commands"), ("my.toml", "disturbances")] {
            let text = by_page[key].as_str().expect("a text");
            assert!(!text.is_empty(), "{key}");
            fs::write(command_line.folder().join(file), text).expect("it can be written");
        }
        let ended = command_line.run(&format!(
            "walk --robot {robot} --seed {seed} --lockstep --from-stand --for {SECONDS}s --commands my.jsonl \
             --disturbances my.toml --out {robot} --json"
        ));
        assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        let summary: Value = serde_json::from_str(&ended.stdout).expect("a summary");
        assert_eq!(summary["setpoint_hash"], by_page["hash"], "{robot}");
        assert_eq!(summary["mode"], "standing", "{robot}");
    }
}
