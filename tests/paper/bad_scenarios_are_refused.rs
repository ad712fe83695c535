//! Goal: a scenario with a mistake is refused, and the message names file, line, key, value and what would be right;
//! all mistakes at once.
//!
//! Method: a good scenario, spoiled one way at a time.

use config::Config;
use paper::{Reading, Scenario};

const GOOD: &str = r#"figure = 14
title = "speed 1.1"
paper_verdict = "in"

[request]
turn_deg = 0
speed = 1.1
extension_deg = 0

[lean]
at = "ankle"
angles_deg = [-2, 0.5]
"#;

/// What is said about a text as `figure_14.toml`.
fn complaint(text: &str) -> String {
    Scenario::from_toml(text, "figure_14.toml").map_or_else(|errors| errors.to_string(), |_| String::new())
}

#[test]
fn a_good_scenario_is_accepted() {
    assert_eq!(complaint(GOOD), "");
    let without_lean = GOOD.split("[lean]").next().unwrap();
    assert_eq!(complaint(without_lean), "");
}

#[test]
fn each_mistake_of_a_scenario_is_named() {
    for (good, bad, expected) in [
        ("figure = 14", "figure = 15", "figure_14.toml:1:10: figure = 15: must be 14, the number in the file's name"),
        (r#""in""#, r#""yes""#, r#"paper_verdict = "yes": must be one of "in", "out", "not stated""#),
        ("turn_deg = 0", "turn = 0", "unknown key; write `turn_deg`"),
        ("turn_deg = 0", "turn_deg = 90", "figure_14.toml:6:12: request.turn_deg = 90: must lie between -45 and 45"),
        ("speed = 1.1", "speed = 0", "request.speed = 0: must lie between 0.1 and 2"),
        ("speed = 1.1\n", "", "request.speed: is missing"),
        ("extension_deg = 0", "extension_deg = nan", "request.extension_deg = nan: must be a finite number"),
        (r#""ankle""#, r#""hip""#, r#"lean.at = "hip": must be one of "ankle", "trunk""#),
        ("[-2, 0.5]", "[-2]", "lean.angles_deg = [-2]: must be an array of 2 finite numbers"),
        ("[-2, 0.5]", "[-60, 0]", "lean.angles_deg = [-60, 0]: must be two angles of at most 45°"),
        ("title = \"speed 1.1\"", "title = \"\"", "title = \"\": must be a text in quotes"),
        ("[lean]", "[lean]\nside = 1", "lean.side = 1: unknown key"),
    ] {
        assert!(GOOD.contains(good), "{good}");
        let found = complaint(&GOOD.replace(good, bad));
        assert!(found.contains(expected), "{bad}: says `{found}` instead of `{expected}`");
    }
}

#[test]
fn all_mistakes_of_a_scenario_are_named_at_once() {
    let bad = GOOD.replace("speed = 1.1\n", "speed = -1\n").replace("\"ankle\"", "\"hip\"").replace("[-2, 0.5]", "2");
    assert_eq!(complaint(&bad).lines().count(), 3, "{}", complaint(&bad));
}

#[test]
fn mistakes_of_paper_toml_are_named() {
    assert!(Reading::from_toml("[ramp]\nturn = \"linear\"\nextension = \"quintic\"", "paper.toml").is_ok());
    let errors = Reading::from_toml("[ramp]\nturn = \"cubic\"", "paper.toml").unwrap_err().to_string();
    assert!(
        errors.contains("paper.toml:2:8: ramp.turn = \"cubic\": must be one of \"linear\", \"quintic\""),
        "{errors}"
    );
    assert!(errors.contains("ramp.extension: is missing"), "{errors}");
}
