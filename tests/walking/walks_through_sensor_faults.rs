//! The robot walks on through sensor faults of 10 ms, and does not fall through any of 200 ms.
//!
//! Method: the nominal walk in lockstep, each fault at two phases of the half-step, and three seconds more.

use config::Config;
use halfstep_tests::walking::Walking;
use interface::Mode;
use plant::Disturbances;

const FAULTS: [&str; 10] = [
    "kind = \"freeze\"",
    "kind = \"freeze\"\nvalues = \"orientation\"",
    "kind = \"nan\"",
    "kind = \"nan\"\nvalues = \"angles\"\njoint = \"left_knee\"",
    "kind = \"spike\"\nvalues = \"angles\"\njoint = \"left_knee\"\nsize_deg = 300",
    "kind = \"spike\"\nvalues = \"feet\"\nsize_n = 500",
    "kind = \"spike\"\nvalues = \"angular_rate\"\nsize_deg_per_s = 1000",
    "kind = \"spike\"\nvalues = \"orientation\"\nsize_deg = 90",
    "kind = \"drop_out\"",
    "kind = \"delay\"\ndelay_periods = 10",
];

/// What the controller does three seconds after a fault.
fn mode_after(fault: &str, start: f64, lasts: f64) -> Mode {
    let script = format!("[[sensor_fault]]\nat_s = {start}\nlasts_s = {lasts}\n{fault}");
    let mut walking = Walking::begin(1);
    walking.plant.disturbances = Disturbances::from_toml(&script, "script").unwrap_or_else(|errors| panic!("{errors}"));
    let truth = walking.walk(start + lasts + 3.0);
    let mode = walking.tick(None).report.mode;
    assert!(!truth.has_fallen() && mode != Mode::Fallen, "fell after `{fault}` for {lasts} s from {start} s");
    mode
}

#[test]
fn walks_on_through_any_sensor_fault_of_10_ms() {
    for fault in FAULTS {
        for start in [2.5, 2.85] {
            assert_eq!(mode_after(fault, start, 0.01), Mode::Walking, "`{fault}` from {start} s");
        }
    }
}

#[test]
fn stays_up_through_any_sensor_fault_of_200_ms() {
    for fault in FAULTS {
        for start in [2.5, 2.85] {
            mode_after(fault, start, 0.2);
        }
    }
}
