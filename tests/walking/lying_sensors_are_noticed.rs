//! Sensors whose values are plausible and wrong for good are noticed: the robot stops with a latched fault before it
//! falls, or in any case does not walk on as if nothing had happened. Clean walks raise no alarm.
//!
//! Method: the nominal walk in lockstep; each fault begins at four phases of the half-step and lasts for six seconds.

use config::Config;
use halfstep_tests::random;
use halfstep_tests::walking::{Walking, controller_parameters};
use interface::{Fault, GaitChange, Mode};
use plant::Disturbances;
use rand::Rng;

/// Longest time until a fault is noticed (s).
const NOTICED_WITHIN: f64 = 0.3;

const FAULTS: [&str; 14] = [
    "kind = \"freeze\"",
    "kind = \"freeze\"\nvalues = \"orientation\"",
    "kind = \"freeze\"\nvalues = \"angular_rate\"",
    "kind = \"freeze\"\nvalues = \"feet\"",
    "kind = \"freeze\"\nvalues = \"angles\"",
    "kind = \"freeze\"\nvalues = \"rates\"",
    "kind = \"freeze\"\nvalues = \"angles\"\njoint = \"right_hip_pitch\"",
    "kind = \"spike\"\nvalues = \"orientation\"\nsize_deg = 3",
    "kind = \"spike\"\nvalues = \"orientation\"\nsize_deg = -8",
    "kind = \"spike\"\nvalues = \"angular_rate\"\nsize_deg_per_s = 30",
    "kind = \"spike\"\nvalues = \"angular_rate\"\nsize_deg_per_s = -200",
    "kind = \"spike\"\nvalues = \"angles\"\njoint = \"right_hip_roll\"\nsize_deg = 10",
    "kind = \"spike\"\nvalues = \"angles\"\njoint = \"left_hip_roll\"\nsize_deg = -10",
    "kind = \"spike\"\nvalues = \"angles\"\njoint = \"left_knee\"\nsize_deg = 10",
];

#[test]
fn every_lasting_sensor_fault_is_noticed_and_ends_the_walk() {
    let mut falls = Vec::new();
    for fault in FAULTS {
        for phase in 0..4 {
            let start = 2.43 + 0.15 * f64::from(phase);
            let script = format!("[[sensor_fault]]\nat_s = {start}\nlasts_s = 6\n{fault}");
            let mut walking = Walking::begin(1);
            walking.plant.disturbances = Disturbances::from_toml(&script, "script").unwrap();
            walking.walk(start);
            let mut noticed = None;
            let mut mode = Mode::Walking;
            while walking.time() < start + 6.0 {
                let report = walking.tick(None).report;
                mode = report.mode;
                let is_noticed = report.faults.contains(Fault::MeasurementImplausible)
                    || report.faults.contains(Fault::MeasurementStale);
                if is_noticed && noticed.is_none() {
                    noticed = Some(walking.time() - start);
                }
            }
            let after = noticed.unwrap_or(f64::INFINITY);
            assert!(after < NOTICED_WITHIN, "`{fault}` from {start} s: noticed after {after} s");
            assert!(matches!(mode, Mode::Faulted | Mode::Fallen), "`{fault}` from {start} s: {mode:?}");
            if walking.plant.truth().has_fallen() {
                falls.push(format!("{fault} from {start:.2} s"));
            }
        }
    }
    println!("{} falls of {}: {falls:#?}", falls.len(), 4 * FAULTS.len());
    assert!(falls.len() <= FALLS_MAX, "{falls:#?}");
}

/// Falls in spite of it: a gyro that is off by 30 °/s from one sample to the next has pushed the robot before the
/// orientation contradicts it, 25 ms later.
const FALLS_MAX: usize = 3;

#[test]
fn no_alarm_is_raised_by_a_minute_of_any_commands() {
    for seed in 0..3 {
        let mut random = random(seed);
        let limits = controller_parameters().gait.limits;
        let mut walking = Walking::begin(seed);
        for tick in 0..60_000 {
            let change = GaitChange {
                turn: Some(random.random_range(-limits.turn_max..=limits.turn_max)),
                speed: Some(random.random_range(limits.speed_min..=limits.speed_max)),
                extension: Some(random.random_range(limits.extension_min..=limits.extension_max)),
            };
            let report = walking.tick((tick % 1500 == 700).then_some((&change, None))).report;
            assert!(!report.faults.contains(Fault::MeasurementImplausible), "seed {seed}, tick {tick}");
        }
    }
}
