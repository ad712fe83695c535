//! Goal: the committed nominal is what its command makes, bit for bit.
//! Method: make it twice and compare with each other and with the file.

mod common;

use common::{config, mechanism};
use gait::NominalTable;
use synthesis::{LegPattern, SynthesisParameters, synthesize};

/// The command that the committed file names.
const MADE_BY: &str = "halfstep synthesize --mechanism config/mechanism.toml --out config/nominal_half_step.csv";

fn committed_nominal() -> NominalTable {
    let mechanism = mechanism("mechanism.toml");
    let made = synthesize(&mechanism, &LegPattern::Pendulum, &SynthesisParameters::default(), MADE_BY);
    made.unwrap_or_else(|error| panic!("{error}")).table
}

#[test]
fn two_runs_of_the_synthesis_give_the_same_bits() {
    let [first, second] = [committed_nominal(), committed_nominal()].map(|table| table.to_csv().expect("text"));
    assert!(first == second);
}

/// When the nominal is changed on purpose, the command in the file's header makes the new file.
#[test]
fn the_committed_nominal_is_made_by_the_command_in_its_header() {
    let file = std::fs::read_to_string(config("nominal_half_step.csv")).expect("the committed nominal");
    let made = committed_nominal().to_csv().expect("text");
    let different = file.lines().zip(made.lines()).position(|(file, made)| file != made);
    assert_eq!(different, None, "first different line, counted from 0");
    assert!(file == made);
}
