//! A simulated robot that has fallen is put on its feet, reset, and walks again within one run.

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

const FALL: &str = "[[push]]\nat_s = 2.2\nlasts_s = 0.1\nimpulse_n_s = [30, 85, 0]\n";
/// It falls by 4 s and is lifted 2 s later. What is asked before is refused.
const COMMANDS: &str = r#"{"t":4.5,"intent":"reset"}
{"t":7,"intent":"reset"}
{"t":11,"intent":"walk"}
"#;

#[test]
fn a_walk_goes_on_after_a_fall() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let write = |name: &str, text: &str| std::fs::write(command_line.folder().join(name), text).expect("it is written");
    write("fall.toml", FALL);
    write("commands.jsonl", COMMANDS);
    let words =
        "walk --lockstep --for 15s --lift-when-fallen --disturbances fall.toml --commands commands.jsonl --json";
    let ended = command_line.run(words);
    assert_eq!(ended.code, Some(1), "it fell: {}", ended.stderr);
    let summary: Value = serde_json::from_str(&ended.stdout).expect("JSON");
    assert_eq!(summary["falls"], 1, "{summary:#}");
    assert_eq!(summary["mode"], "walking", "{summary:#}");
    assert_eq!(summary["requests"]["refused"], 1, "{summary:#}");
    assert!(
        ended.stderr.contains("at 4.50 s, reset: "),
        "the first reset is refused with its reason: {}",
        ended.stderr
    );
    assert!(ended.stderr.contains("plant: the robot is on its feet again at "), "{}", ended.stderr);
    assert!(summary["fault"]["cleared_at_s"].as_f64().is_some_and(|cleared| (7.0..7.1).contains(&cleared)));
    // Half-steps before the fall and after it: two of the start and one every 0.6 s.
    assert!(summary["half_steps"].as_u64().is_some_and(|count| (8..=10).contains(&count)), "{summary:#}");
}
