//! Bad configuration is refused with every error of every file: with file, line, key, value and what would be right.

use halfstep_tests::command_line::CommandLine;

fn spoilt() -> CommandLine {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    command_line.edit("config/mechanism.toml", "resistance_ohm = 0.608", "resistance_ohm = -0.608");
    command_line.edit("config/controller.toml", "gain = ", "gian = ");
    command_line.edit("config/plant.toml", "friction = ", "friction = -");
    command_line.edit("config/nominal_half_step.csv", "# duration_s = 0.6", "# duration_s = soon");
    command_line
}

#[test]
fn check_lists_every_error_of_every_file() {
    let command_line = spoilt();
    command_line.edit("config/commands_demo.jsonl", "\"speed\"", "\"sped\"");
    let ended = command_line.run("check");
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""));
    for (file, text, wanted) in [
        ("config/mechanism.toml", "-0.608", "motor.leg.resistance_ohm = -0.608: must lie between 0.001 and 10000"),
        ("config/nominal_half_step.csv", "soon", "the header says `# duration_s = soon` where it must say"),
        ("config/controller.toml", "gian", "unknown key"),
        ("config/controller.toml", "[feedback]", "feedback.gain: is missing"),
        ("config/plant.toml", "friction = -", "must lie between 0.01 and 10"),
        ("config/commands_demo.jsonl", "sped", "unknown field `sped`, expected one of `t`, `turn_deg`, `speed`"),
    ] {
        let line = 1 + command_line.read(file).lines().position(|line| line.contains(text)).expect("it was spoilt");
        let place = format!("{file}:{line}:");
        let says = |error: &str| error.starts_with(&place) && error.contains(wanted);
        assert!(ended.stderr.lines().any(says), "{place} {wanted}\nis not in\n{}", ended.stderr);
    }
}

#[test]
fn no_process_starts_with_bad_configuration() {
    let command_line = spoilt();
    let check = command_line.run("check").stderr;
    let walk = command_line.run("walk --for 1s");
    assert_eq!((walk.code, walk.stdout.as_str()), (Some(2), ""));
    assert_eq!(walk.stderr, check, "all errors at once here, too");
    assert!(!command_line.folder().join("runs").exists(), "nothing was begun");
    assert_eq!(command_line.start_here("controller").finish().code, Some(2));
    assert_eq!(command_line.start_here("plant").finish().code, Some(2));
}

#[test]
fn a_nominal_for_another_mechanism_is_refused() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let ended = command_line.run("check --mechanism config/mechanism_other_reading.toml");
    assert_eq!(ended.code, Some(2));
    let says = "config/nominal_half_step.csv: made for the mechanism 0x";
    assert!(ended.stderr.starts_with(says), "{}", ended.stderr);
    assert!(ended.stderr.contains("make one for it with `halfstep synthesize --mechanism"), "{}", ended.stderr);
}

#[test]
fn a_wrong_script_is_refused_before_anything_starts() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    std::fs::write(command_line.folder().join("script.jsonl"), "{\"t\":1,\"speed\":\"fast\"}\n{\"t\":2}\n").unwrap();
    let ended = command_line.run("walk --for 1s --commands script.jsonl");
    assert_eq!(ended.code, Some(2));
    let lines: Vec<&str> = ended.stderr.lines().collect();
    assert_eq!(lines.len(), 2, "{lines:?}");
    assert!(lines[0].starts_with("script.jsonl:1: invalid type: string \"fast\", expected f64"), "{lines:?}");
    assert!(lines[1].starts_with("script.jsonl:2: no command in this line; write e.g. {"), "{lines:?}");
}

#[test]
fn the_committed_configuration_is_good() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let ended = command_line.run("check --json");
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let facts: serde_json::Value = serde_json::from_str(&ended.stdout).unwrap();
    assert!((facts["mass_kg"].as_f64().unwrap() - 73.031).abs() < 1e-9);
    assert!(facts["zmp_residual_mm"].as_f64().unwrap() <= 1.0, "{facts}");
}
