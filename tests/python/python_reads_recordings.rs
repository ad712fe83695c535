//! A recording opens in PyPI's `mcap`: all messages, to the bit, and without any of our code.
//!
//! Needs Python: `cargo test --workspace --tests -- --ignored`.

use halfstep_tests::command_line::CommandLine;
use halfstep_tests::{python, repository};
use record::{Recording, RunEvent};

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn python_reads_every_message_of_a_recording() {
    let mut python = python();
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    assert_eq!(command_line.run("walk --lockstep --for 3s --out run").code, Some(0));
    let file = command_line.folder().join("run/run.mcap");
    let script = repository().join("tools/python/examples/recording.py");
    let told = python.arg(script).arg(&file).output().expect("Python");
    assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
    let said = String::from_utf8_lossy(&told.stdout).into_owned();

    let size = command_line.read("config/mechanism.toml").len();
    for line in [
        format!("attached mechanism.toml {size}"),
        "/measurements 3000".to_owned(),
        "/reports 3000".to_owned(),
        "/setpoints 3000".to_owned(),
        "/ticks 3000".to_owned(),
        "/truth 601".to_owned(),
        "/requests 1".to_owned(),
        "/replies 1".to_owned(),
    ] {
        assert!(said.lines().any(|there| there == line), "{line} is not in\n{said}");
    }

    let (mut recording, mut knee) = (Recording::open(&file).unwrap(), f64::NAN);
    while let Some(stamped) = recording.next_event().unwrap() {
        if let RunEvent::Measurement(measured) = stamped.event {
            knee = measured.angles[4];
        }
    }
    let hex = said.lines().last().unwrap().rsplit(' ').next().unwrap();
    assert_eq!(from_hex(hex), knee, "{said}");
}

/// What Python's `float.hex` wrote, exactly.
fn from_hex(hex: &str) -> f64 {
    let (sign, digits) = hex.strip_prefix('-').map_or((1.0, hex), |digits| (-1.0, digits));
    let (mantissa, exponent) = digits.trim_start_matches("0x1.").split_once('p').expect("a normal number");
    let fraction = u64::from_str_radix(mantissa, 16).expect("13 digits") as f64 / 2_f64.powi(52);
    sign * (1.0 + fraction) * 2_f64.powi(exponent.parse().expect("a number"))
}
