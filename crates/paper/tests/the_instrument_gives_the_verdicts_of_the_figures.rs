//! Goal: with the numbers of our reading the instrument gives the verdicts of `halfstep paper`, to the last bit; with
//! other numbers those of the search; a number that makes no sense is named.
//!
//! Method: against [`reproduce`] on the committed robot, and against what docs/paper.md tells of other numbers.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use config::Config;
use gait::{NominalTable, Robot};
use model::Mechanism;
use paper::{
    FileText, Instrument, InstrumentAnswer, Question, Reading, Scenario, built_in_other_axes, built_in_reading,
    built_in_scenarios, reproduce,
};

fn config() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config")
}

fn robot() -> Robot {
    let mechanism = Mechanism::load(config().join("mechanism.toml")).expect("the committed mechanism");
    let nominal = NominalTable::read_csv(&config().join("nominal_half_step.csv")).expect("the committed half-step");
    Robot { mechanism, nominal: Arc::new(nominal) }
}

fn instrument() -> Instrument {
    let name = "mechanism.toml".to_owned();
    let text = std::fs::read_to_string(config().join(&name)).expect("the committed mechanism");
    let mechanisms = vec![FileText { name, text }, built_in_other_axes()];
    Instrument::new(mechanisms, &robot(), built_in_reading(), &built_in_scenarios()).expect("the committed files")
}

fn with(numbers: &[(&str, f64)]) -> Question {
    let numbers = numbers.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    Question { numbers, ..Question::default() }
}

fn misses(answer: &InstrumentAnswer) -> Vec<u64> {
    answer.verdicts.iter().filter(|row| !row.agrees).map(|row| row.figure).collect()
}

#[test]
fn all_scenarios_of_the_folder_are_carried() {
    let carried: Vec<_> = built_in_scenarios().iter().map(|file| Scenario::from_toml(&file.text, &file.name)).collect();
    let carried: Vec<Scenario> = carried.into_iter().collect::<Result<_, _>>().expect("scenarios");
    assert_eq!(carried, Scenario::load_all(&config().join("scenarios")).expect("the committed scenarios"));
}

#[test]
fn our_numbers_give_the_verdicts_of_the_figures_to_the_last_bit() {
    let reading = Reading::load(config().join("paper.toml")).expect("the committed reading");
    let mut instrument = instrument();
    let answer = instrument.answer(&Question::default()).expect("it walks");
    assert_eq!((answer.agree, answer.verdicts.len(), misses(&answer)), (36, 38, vec![7, 32]));
    // Stated by name, the same numbers are the same question.
    let dials = instrument.dials();
    let by_name: Vec<_> = dials.numbers.iter().map(|dial| (dial.name, dial.value)).collect();
    assert_eq!(instrument.answer(&with(&by_name)).expect("it walks"), answer);

    let scenarios = Scenario::load_all(&config().join("scenarios")).expect("the committed scenarios");
    let figures = scenarios.iter().map(|scenario| reproduce(&robot(), reading, scenario).expect("it walks"));
    let stated: Vec<_> = figures.filter(|figure| figure.agrees().is_some()).collect();
    for (figure, row) in stated.iter().zip(&answer.verdicts) {
        assert_eq!((figure.scenario.figure, &figure.scenario.title), (row.figure, &row.title));
        assert_eq!(figure.extents.margin * 1e3, row.margin_mm, "figure {}", row.figure);
        let here = if figure.is_inside() { "in" } else { "out" };
        assert_eq!((row.here, row.paper), (here, figure.scenario.paper_verdict.text()));
        assert_eq!(figure.agrees(), Some(row.agrees));
    }
}

#[test]
fn a_longer_heel_and_a_shorter_half_step_give_37_verdicts() {
    let mut instrument = instrument();
    let mut asked = |heel, duration| {
        let numbers = [("heel_m", heel), ("duration_s", duration)];
        misses(&instrument.answer(&with(&numbers)).expect("it walks"))
    };
    assert_eq!(asked(0.081, 0.55), [7]);
    assert_eq!(asked(0.08, 0.55), [7, 32]);
    assert_eq!(asked(0.07, 0.6), [7, 32], "what was asked before leaves nothing behind");
}

#[test]
fn other_ramps_and_axes_give_what_is_told_of_them() {
    let mut instrument = instrument();
    let linear = Question { turn_ramp: Some("linear".to_owned()), ..Question::default() };
    assert_eq!(misses(&instrument.answer(&linear).expect("it walks")), [6, 7, 32]);
    let axes = Some("mechanism_other_reading.toml".to_owned());
    let other = instrument.answer(&Question { axes, ..Question::default() }).expect("it walks");
    assert_eq!(other.agree, 27);
}

#[test]
fn masses_and_heights_move_the_margins() {
    let mut instrument = instrument();
    let as_read = instrument.answer(&Question::default()).expect("it walks");
    for name in ["leg_mass_share", "arm_mass_share", "trunk_mass_share", "hip_height_share", "stature_share"] {
        let answer = instrument.answer(&with(&[(name, 0.95)])).expect("it walks");
        let pairs = answer.verdicts.iter().zip(&as_read.verdicts);
        let moved = pairs.map(|(row, before)| (row.margin_mm - before.margin_mm).abs()).fold(0.0, f64::max);
        assert!((0.01..30.0).contains(&moved), "{name}: {moved} mm");
    }
}

#[test]
fn a_figure_is_drawn_with_the_numbers_of_the_question() {
    let mut instrument = instrument();
    let mut drawn = |numbers: &[(&str, f64)], figure| {
        let question = Question { figure: Some(figure), ..with(numbers) };
        instrument.answer(&question).expect("it walks").drawn.expect("it was asked for")
    };
    let (before, after) = (drawn(&[], 32), drawn(&[("heel_m", 0.082)], 32));
    assert_eq!((before.figure, before.summary.contains(": out; the paper: in")), (32, true), "{}", before.summary);
    assert!(after.summary.contains(": in; the paper: in"), "{}", after.summary);
    assert!(before.svg.starts_with("<svg") && after.svg.contains("in; the paper: in"));
    // The paper states no verdict of it.
    assert!(drawn(&[], 23).summary.ends_with("not stated"));
}

#[test]
fn a_number_that_makes_no_sense_is_named() {
    let mut instrument = instrument();
    let mut complaint = |question: &Question| match instrument.answer(question) {
        Ok(answer) => format!("{} verdicts", answer.agree),
        Err(error) => error.to_string(),
    };
    for (name, value, expected) in [
        ("heel_m", -1.0, "heel_m = -1: must lie between 0.025 and 0.125"),
        ("heel_m", f64::NAN, "heel_m = NaN: must lie"),
        ("duration_s", 1e300, "duration_s = 1"),
        ("stature_share", 0.0, "stature_share = 0: must lie between 0.8 and 1.2"),
        ("heel", 0.07, "heel: unknown number; the numbers are heel_m, toe_m"),
    ] {
        let found = complaint(&with(&[(name, value)]));
        assert!(found.starts_with(expected), "{found} instead of {expected}");
    }
    let cubic = Question { turn_ramp: Some("cubic".to_owned()), ..Question::default() };
    assert_eq!(complaint(&cubic), "turn_ramp = \"cubic\": must be one of \"linear\", \"quintic\"");
    assert_eq!(
        complaint(&Question { figure: Some(38), ..Question::default() }),
        "figure 38: there is no scenario of it"
    );
    let stretched = complaint(&with(&[("step_length_m", 0.5), ("hip_height_share", 1.05)]));
    assert!(stretched.starts_with("with these numbers it cannot walk: row"), "{stretched}");
}
