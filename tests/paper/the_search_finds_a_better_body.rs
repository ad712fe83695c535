//! Goal: `halfstep paper --search` finds a body with which 37 verdicts hold where there is a known one, the same one
//! each time, and writes it as a folder in which `halfstep paper` counts the same.
//!
//! Method: only the heel and T may change. With a heel of 81 mm and T = 0.55 s 37 verdicts hold, with one of 80 mm 36.

use std::fs;

use config::Config;
use gait::Robot;
use halfstep_tests::command_line::CommandLine;
use halfstep_tests::paper::{config, misses, reading, robot, scenarios};
use model::Mechanism;
use paper::{
    Candidate, FileText, Freedom, OPEN_NUMBERS, Open, Scenario, SearchBase, SearchOptions, SearchReport, reproduce,
    search,
};

const COMMAND: &str = "paper --search --vary heel_m,duration_s --candidates 60";

fn found(threads: usize, seed: u64) -> (Candidate, SearchReport) {
    let text = |name: &str| FileText {
        name: name.to_owned(),
        text: fs::read_to_string(config().join(name)).expect("a committed file"),
    };
    let reading_text = text("paper.toml").text;
    let mechanisms = vec![text("mechanism.toml")];
    let base = SearchBase::new(mechanisms, &robot(), reading(), reading_text, scenarios()).expect("a robot to scale");
    let varied = [Open::Heel, Open::Duration].map(|open| OPEN_NUMBERS[open as usize].name);
    let freedom =
        Freedom { numbers: OPEN_NUMBERS.map(|number| varied.contains(&number.name)), ramps: false, axes: false };
    let options = SearchOptions { freedom, seed, candidates: 60, threads };
    search(&base, &options, &mut |_| ()).expect("the committed robot walks")
}

#[test]
fn a_longer_heel_and_a_shorter_half_step_make_37_verdicts_true() {
    let (candidate, report) = found(2, 1);
    assert_eq!((report.verdicts_found(), report.missed_figures().collect::<Vec<_>>()), (37, vec![7]));
    let heel = candidate.value(Open::Heel);
    assert!((0.0805..0.082).contains(&heel), "{heel}");
    assert_eq!((candidate.value(Open::Toe), candidate.value(Open::StepLength)), (0.21, 0.25), "may not change");
}

#[test]
fn the_same_seed_finds_the_same_on_any_number_of_cores() {
    let one = found(1, 7);
    assert_eq!(one, found(3, 7));
    assert_eq!(one.1.to_string(), found(2, 7).1.to_string());
}

#[test]
fn the_found_folder_has_the_verdicts_that_the_search_told() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    command_line.copy_scenarios();
    let ended = command_line.run(&format!("{COMMAND} --out found --json"));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let report: serde_json::Value = serde_json::from_str(&ended.stdout).expect("JSON");
    assert_eq!(report["verdicts_before"], 36);
    assert_eq!(report["verdicts_of_heel_80_mm_and_550_ms"], 36, "figure 32 lacks a millimetre");
    assert_eq!(report["verdicts_found"], 37);

    let ended = command_line.run("paper --config found");
    assert!(ended.stdout.contains("37 of 38 stated verdicts agree"), "{}{}", ended.stdout, ended.stderr);
    // Margins are those of the search, but for rounding.
    let folder = command_line.folder().join("found");
    let mechanism = Mechanism::load(folder.join("mechanism.toml")).unwrap();
    let nominal = gait::NominalTable::read_csv(&folder.join("nominal_half_step.csv")).unwrap();
    let robot = Robot { mechanism, nominal: nominal.into() };
    let scenarios = Scenario::load_all(&folder.join("scenarios")).unwrap();
    let figures: Vec<_> =
        scenarios.iter().map(|scenario| reproduce(&robot, reading(), scenario).expect("it walks")).collect();
    assert_eq!(misses(&figures), [7]);
    for verdict in report["verdicts"].as_array().expect("verdicts") {
        let figure = figures.iter().find(|figure| verdict["figure"] == figure.scenario.figure).expect("its scenario");
        let sign = if verdict["paper_verdict"] == "out" { -1.0 } else { 1.0 };
        let told = verdict["slack_found_mm"].as_f64().expect("a number");
        assert!((told - sign * figure.extents.margin * 1e3).abs() < 1e-9, "{verdict}: {}", figure.extents.margin);
    }
}

#[test]
fn nothing_is_overwritten() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    command_line.copy_scenarios();
    let before = command_line.read("config/mechanism.toml");
    let ended = command_line.run(&format!("{COMMAND} --out config"));
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""));
    assert!(ended.stderr.contains("--out config: exists already; name a new folder"), "{}", ended.stderr);
    assert_eq!(command_line.read("config/mechanism.toml"), before);
}
