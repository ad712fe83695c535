//! Goal: a table read back from its file is the same to the last bit and writes the same bytes; a spoilt file is
//! refused with the place, the value and what would be right.
//!
//! Method: round trips of awkward numbers; one fault at a time in a good file.

mod common;

use std::path::Path;

use gait::{NominalTable, TableFileError};
use model::{Joint, JointVector, PerJoint};
use proptest::prelude::*;

fn read(text: &str) -> Result<NominalTable, TableFileError> {
    NominalTable::from_csv(text, Path::new("nominal.csv"))
}

/// The message for the good file with `from` replaced once by `to`.
fn message(from: &str, to: &str) -> String {
    let good = common::table(&common::mechanism()).to_csv().expect("a good table");
    assert!(good.contains(from), "{from}");
    read(&good.replacen(from, to, 1)).expect_err("a spoilt file").to_string()
}

#[test]
fn a_nominal_file_reads_back_to_the_same_table_and_bytes() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("nominal.csv");
    let table = common::table(&common::mechanism());
    table.write_csv(&file).expect("written");
    let back = NominalTable::read_csv(&file).expect("read");
    assert_eq!(back, table);
    assert_eq!(back.to_csv().expect("text").into_bytes(), std::fs::read(&file).expect("bytes"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_number_of_a_nominal_file_keeps_its_bits(
        values in prop::array::uniform20(prop_oneof![-100.0..100.0, prop::num::f64::SUBNORMAL, prop::num::f64::ZERO]),
        duration in 0.05_f64..10.0,
    ) {
        let mut table = common::table(&common::mechanism());
        table.duration = duration;
        table.rows[3].motion.rates = PerJoint(values);
        let back = read(&table.to_csv().expect("text")).expect("table");
        prop_assert_eq!(back.duration.to_bits(), duration.to_bits());
        let bits = |joints: &JointVector| joints.0.map(f64::to_bits);
        prop_assert_eq!(bits(&back.rows[3].motion.rates), bits(&table.rows[3].motion.rates));
        prop_assert_eq!(back.to_csv().expect("text"), table.to_csv().expect("text"));
    }
}

#[test]
fn columns_of_a_nominal_file_carry_the_papers_joint_numbers() {
    let text = common::table(&common::mechanism()).to_csv().expect("text");
    let names: Vec<_> = text.lines().nth(4).expect("names").split(',').collect();
    assert_eq!(names.len(), 2 + 5 * Joint::COUNT + 12);
    assert_eq!(names[..3], ["interval", "t_s", "joint_01_angle_rad"]);
    assert_eq!(names[21..23], ["joint_20_angle_rad", "joint_01_rate_rad_s"]);
    assert_eq!(names[102..104], ["ground_gravity_fx_n", "ground_gravity_fy_n"]);
    assert_eq!(names[113], "ground_dynamic_mz_nm");
}

#[test]
fn mistakes_in_a_nominal_file_are_reported_with_their_place() {
    assert_eq!(
        message("half-step v1", "half-step v2"),
        "nominal.csv:1: the header says `# halfstep nominal half-step v2` where it must say \
         `# halfstep nominal half-step v1`"
    );
    assert_eq!(
        message("# duration_s = 0.6", "# duration_s = -0.6"),
        "nominal.csv:4: the header says `# duration_s = -0.6` where it must say `# duration_s = ` and then a \
         number of seconds between 0.05 and 10, like 0.6"
    );
    assert_eq!(
        message("joint_02_angle_rad", "joint_2"),
        "nominal.csv:5: column 4 is named `joint_2`; it must be `joint_02_angle_rad`"
    );
    assert_eq!(
        message("\n20,0.5,0.0,", "\n20,0.5,0.0.0,"),
        "nominal.csv:26: joint_01_angle_rad is `0.0.0`; it must be a finite number, like -0.25"
    );
    assert_eq!(
        message("\n20,0.5,0.0,", "\n20,0.5,NaN,"),
        "nominal.csv:26: joint_01_angle_rad is `NaN`; it must be a finite number, like -0.25"
    );
    assert_eq!(
        message("\n20,0.5,", "\n21,0.5,"),
        "nominal.csv:26: interval is `21`; it must be 20: rows count from 0 without gaps"
    );
    assert_eq!(
        message("\n20,0.5,", "\n20,0.51,"),
        "nominal.csv:26: t_s is `0.51`; it must be 0.5: rows are equally spaced from 0 to the duration"
    );
    assert_eq!(
        message("\n20,0.5,0.0,", "\n20,0.5,"),
        "nominal.csv:26: the row has 113 values; it must have 114, one for each column"
    );
    assert!(message("# mechanism: ", "# robot: ").starts_with("nominal.csv:3: the header says `# robot: "));
    assert!(
        NominalTable::read_csv(Path::new("no/such.csv")).expect_err("none").to_string().starts_with("no/such.csv: ")
    );
}

#[test]
fn a_nominal_made_by_a_command_of_several_lines_is_not_written() {
    let mut table = common::table(&common::mechanism());
    table.made_by = "one\ntwo".into();
    assert!(matches!(table.to_csv(), Err(TableFileError::MadeByOnSeveralLines(_))));
}
