//! Goal: an injected fault changes what the script says while it says so, and not a bit of anything else.
//!
//! Method: the same robot moves with and without the fault; its samples are compared one by one.

use config::Config;
use halfstep_tests::mechanism;
use halfstep_tests::walking::plant_parameters;
use interface::{Measurement, SensorGroup, Setpoint};
use model::{Joint, Motion, Side};
use nalgebra::UnitQuaternion;
use plant::{Disturbances, Plant};

/// Samples 0 to 99 of a robot that begins to move, with a fault from sample 40 to 49.
fn samples(fault: &str) -> Vec<Measurement> {
    let script = match fault {
        "" => String::new(),
        fault => format!("[[sensor_fault]]\nat_s = 0.04\nlasts_s = 0.01\n{fault}"),
    };
    let mut plant = Plant::new(&mechanism(), &plant_parameters(), &Motion::default(), 1e-3, 5);
    plant.disturbances = Disturbances::from_toml(&script, "script").unwrap_or_else(|errors| panic!("{errors}"));
    let mut setpoint = Setpoint::default();
    setpoint.angles[Joint::LeftKnee] = 0.5;
    setpoint.angles[Joint::WaistPitch] = 0.2;
    std::iter::once(plant.measure()).chain((1..100).map(|_| plant.step(&setpoint))).collect()
}

/// Compares with the faultless samples: equal outside of samples 40 to `end` − 1, and there as `check` says, which is
/// given faulty and faultless sample and the faultless one just before the fault.
fn assert_fault_until(end: usize, fault: &str, check: impl Fn(&Measurement, &Measurement, &Measurement)) {
    let (faultless, faulty) = (samples(""), samples(fault));
    for number in 0..100 {
        assert_eq!(faultless[number].sample, number as u64);
        if (40..end).contains(&number) {
            check(&faulty[number], &faultless[number], &faultless[39]);
        } else {
            assert_eq!(faulty[number], faultless[number], "{fault}: sample {number}");
        }
    }
}

fn assert_fault(fault: &str, check: impl Fn(&Measurement, &Measurement, &Measurement)) {
    assert_fault_until(50, fault, check);
}

#[test]
fn a_freeze_repeats_the_value_before_it() {
    assert_fault("kind = \"freeze\"", |faulty, good, before| {
        assert_eq!(*faulty, Measurement { sample: good.sample, ..*before });
    });
    assert_fault("kind = \"freeze\"\nvalues = \"orientation\"", |faulty, good, before| {
        assert_eq!(*faulty, Measurement { orientation: before.orientation, ..*good });
    });
    assert_fault("kind = \"freeze\"\nvalues = \"rates\"\njoint = \"left_knee\"", |faulty, good, before| {
        let mut expected = *good;
        expected.rates[Joint::LeftKnee] = before.rates[Joint::LeftKnee];
        assert_eq!(*faulty, expected);
    });
}

#[test]
fn a_nan_fault_replaces_only_the_named_values() {
    assert_fault("kind = \"nan\"\nvalues = \"angles\"\njoint = \"left_knee\"", |faulty, good, _| {
        assert!(faulty.angles[Joint::LeftKnee].is_nan());
        let mut repaired = *faulty;
        repaired.angles[Joint::LeftKnee] = good.angles[Joint::LeftKnee];
        assert_eq!(repaired, *good);
    });
    assert_fault("kind = \"nan\"", |faulty, good, _| {
        assert_eq!(faulty.sample, good.sample);
        let values = faulty.angles.0.iter().chain(&faulty.rates.0).chain(&faulty.currents.0);
        let feet = faulty.feet.iter().flat_map(|foot| foot.force.iter().chain(foot.moment.iter()));
        let imu = faulty.orientation.coords.iter().chain(faulty.angular_rate.iter());
        assert!(values.chain(feet).chain(imu).all(|value| value.is_nan()));
    });
}

#[test]
fn a_spike_adds_its_size_to_the_named_values() {
    assert_fault("kind = \"spike\"\nvalues = \"feet\"\nfoot = \"left\"\nsize_n = 5000", |faulty, good, _| {
        let mut expected = *good;
        expected.feet[Side::Left.index()].force.z += 5000.0;
        assert_eq!(*faulty, expected);
    });
    assert_fault("kind = \"spike\"\nvalues = \"orientation\"\nsize_deg = 90", |faulty, good, _| {
        let [good_orientation, faulty_orientation] =
            [good, faulty].map(|sample| UnitQuaternion::new_unchecked(sample.orientation));
        assert!((good_orientation.angle_to(&faulty_orientation).to_degrees() - 90.0).abs() < 1e-9);
        assert_eq!(Measurement { orientation: good.orientation, ..*faulty }, *good);
    });
    assert_fault("kind = \"spike\"\nvalues = \"angular_rate\"\nsize_deg_per_s = 180", |faulty, good, _| {
        let expected = good.angular_rate.add_scalar(std::f64::consts::PI);
        assert_eq!(*faulty, Measurement { angular_rate: expected, ..*good });
    });
}

#[test]
fn a_drift_grows_from_nothing() {
    assert_fault("kind = \"drift\"\nvalues = \"angles\"\njoint = \"left_knee\"\nsize_deg = 100", |faulty, good, _| {
        let since = (good.sample - 40) as f64 * 1e-3;
        let off = faulty.angles[Joint::LeftKnee] - good.angles[Joint::LeftKnee];
        assert!((off - 100_f64.to_radians() * since).abs() < 1e-12, "{off} rad after {since} s");
        let mut repaired = *faulty;
        repaired.angles[Joint::LeftKnee] = good.angles[Joint::LeftKnee];
        assert_eq!(repaired, *good);
    });
}

#[test]
fn a_saturated_sensor_stops_at_the_end_of_its_range() {
    assert_fault("kind = \"saturate\"\nvalues = \"feet\"\nsize_n = 300", |faulty, good, _| {
        for (faulty, good) in faulty.feet.iter().zip(&good.feet) {
            assert_eq!(faulty.force.z, good.force.z.clamp(-300.0, 300.0));
            assert_eq!((faulty.force.xy(), faulty.moment), (good.force.xy(), good.moment));
        }
        assert_eq!(Measurement { feet: good.feet, ..*faulty }, *good);
    });
}

#[test]
fn a_reversed_sensor_has_the_opposite_sign() {
    assert_fault("kind = \"reverse\"\nvalues = \"rates\"", |faulty, good, _| {
        assert_eq!(*faulty, Measurement { rates: -good.rates, ..*good });
    });
    assert_fault("kind = \"reverse\"\nvalues = \"orientation\"", |faulty, good, _| {
        let product = UnitQuaternion::new_normalize(faulty.orientation * good.orientation);
        assert!(product.angle() < 1e-9, "{} rad", product.angle());
    });
}

#[test]
fn swapped_sensors_exchange_right_and_left() {
    assert_fault("kind = \"swap\"\nvalues = \"feet\"", |faulty, good, _| {
        assert_eq!(*faulty, Measurement { feet: [good.feet[1], good.feet[0]], ..*good });
    });
    assert_fault("kind = \"swap\"\nvalues = \"angles\"\njoint = \"right_knee\"", |faulty, good, _| {
        let mut expected = *good;
        expected.angles[Joint::RightKnee] = good.angles[Joint::LeftKnee];
        assert_eq!(*faulty, expected);
    });
}

#[test]
fn at_half_the_rate_every_sample_comes_twice() {
    let faultless = samples("");
    assert_fault("kind = \"half_rate\"", |faulty, good, _| {
        assert_eq!(*faulty, faultless[(good.sample - good.sample % 2) as usize]);
    });
}

#[test]
fn a_drop_out_repeats_the_last_sample() {
    assert_fault("kind = \"drop_out\"", |faulty, _, before| assert_eq!(faulty, before));
}

/// For three periods nothing comes, then what is three periods old; afterwards all is there at once.
#[test]
fn a_delay_gives_samples_that_many_periods_late() {
    let faultless = samples("");
    assert_fault("kind = \"delay\"\ndelay_periods = 3", |faulty, good, _| {
        let number = (good.sample - 3).max(39);
        assert_eq!(*faulty, faultless[number as usize]);
    });
}

/// Faults at the same time act one after the other.
#[test]
fn simultaneous_faults_act_one_after_the_other() {
    let second = "[[sensor_fault]]\nat_s = 0.04\nlasts_s = 0.01\nkind = \"spike\"\nvalues = \"currents\"\nsize_a = 7";
    assert_fault(&format!("kind = \"freeze\"\nvalues = \"angles\"\n{second}"), |faulty, good, before| {
        assert_eq!(faulty.angles, before.angles);
        assert_eq!(faulty.currents[Joint::LeftElbow], good.currents[Joint::LeftElbow] + 7.0);
        assert_eq!((faulty.rates, faulty.feet), (good.rates, good.feet));
    });
}

#[test]
fn a_missing_group_is_said_to_be_missing() {
    for (values, groups) in [
        ("orientation", vec![SensorGroup::Orientation]),
        ("specific_force", vec![SensorGroup::SpecificForce]),
        ("feet", vec![SensorGroup::RightFoot, SensorGroup::LeftFoot]),
        ("angles\"\njoint = \"left_knee", vec![SensorGroup::Joints]),
    ] {
        assert_fault(&format!("kind = \"missing\"\nvalues = \"{values}\""), |faulty, good, _| {
            assert_eq!(faulty.missing.iter().collect::<Vec<_>>(), groups, "{values}");
            assert_eq!(faulty.rates, good.rates, "{values}");
        });
    }
}

#[test]
fn a_spike_of_the_accelerometer_adds_its_size() {
    assert_fault("kind = \"spike\"\nvalues = \"specific_force\"\nsize_m_per_s2 = 5", |faulty, good, _| {
        assert_eq!(faulty.specific_force, good.specific_force.add_scalar(5.0));
        assert_eq!(faulty.angular_rate, good.angular_rate);
    });
}
