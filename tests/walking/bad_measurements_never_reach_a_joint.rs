//! NaN, infinite, absurd, stale, frozen and out-of-order measurements never reach a joint: what goes out is finite, in
//! range and within the rates, and the report says what was wrong.

use interface::{Fault, Measurement, Mode};
use std::sync::LazyLock;

use controller::Controller;
use gait::Start;
use halfstep_tests::walking::{PERIOD, controller_parameters, nominal};
use halfstep_tests::{mechanism, random};
use model::{Joint, JointVector, Mechanism, Wrench};
use nalgebra::{Quaternion, Vector3};
use rand::Rng;
use rand::rngs::StdRng;

static START: LazyLock<JointVector> = LazyLock::new(|| nominal().rows[0].motion.angles);

fn controller() -> Controller {
    Controller::new(&mechanism(), nominal(), &controller_parameters(), Start::default()).expect("it walks")
}

/// A robot that stands where the walk begins.
fn good(tick: u64) -> Measurement {
    Measurement {
        sample: tick,
        angles: *START,
        rates: JointVector::ZERO,
        feet: [Wrench { force: Vector3::new(0.0, 0.0, 716.0), moment: Vector3::zeros() }, Wrench::ZERO],
        orientation: Quaternion::identity(),
        angular_rate: Vector3::zeros(),
        currents: JointVector::ZERO,
        specific_force: Vector3::z() * model::GRAVITY,
        missing: interface::SensorGroups::NONE,
    }
}

/// One value of a measurement replaced by something that no sensor should say.
fn spoilt(mut measurement: Measurement, random: &mut StdRng) -> Measurement {
    let values = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 1e9];
    let value = values[random.random_range(0..values.len())];
    let joint = Joint::ALL[random.random_range(0..Joint::COUNT)];
    match random.random_range(0..6) {
        0 => measurement.angles[joint] = value,
        1 => measurement.rates[joint] = value,
        2 => measurement.feet[0].force.z = value,
        3 => measurement.feet[1].moment.x = value,
        4 => measurement.orientation.coords.x = value,
        _ => measurement.angular_rate.y = value,
    }
    measurement
}

fn assert_harmless(mechanism: &Mechanism, setpoint: &interface::Setpoint, before: &JointVector) {
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let limits = mechanism.links[joint].limits.expect("a powered joint has limits");
        let (angle, rate) = (setpoint.angles[joint], setpoint.rates[joint]);
        assert!(angle >= limits.angle_min && angle <= limits.angle_max, "{joint:?} sent to {angle} rad");
        assert!(rate.abs() <= limits.rate_max, "{joint:?} sent with {rate} rad/s");
        let moved = (angle - before[joint]).abs();
        assert!(moved <= limits.rate_max * PERIOD * (1.0 + 1e-9), "{joint:?} jumped by {moved} rad");
        assert!(setpoint.feed_forward[joint].abs() < 1000.0, "{joint:?}: {} N·m", setpoint.feed_forward[joint]);
    }
}

#[test]
fn setpoints_stay_within_limits_whatever_the_sensors_measure() {
    let mechanism = mechanism();
    let mut random = random(8);
    for _ in 0..40 {
        let mut controller = controller();
        let mut before = *START;
        for tick in 0..200 {
            let measurement = if random.random_bool(0.5) { spoilt(good(tick), &mut random) } else { good(tick) };
            let report = controller.tick(PERIOD, Some(&measurement));
            assert_harmless(&mechanism, &report.setpoint, &before);
            before = report.setpoint.angles;
        }
    }
}

#[test]
fn reports_name_the_fault_of_a_bad_measurement() {
    let mut controller = controller();
    let mut bad = good(1);
    bad.rates[Joint::LeftKnee] = f64::NAN;
    let faults = controller.tick(PERIOD, Some(&bad)).report.faults;
    assert!(faults.contains(Fault::MeasurementNotFinite));

    let no_orientation = Measurement { orientation: Quaternion::new(0.0, 0.0, 0.0, 0.0), ..good(2) };
    let faults = controller.tick(PERIOD, Some(&no_orientation)).report.faults;
    assert!(faults.contains(Fault::MeasurementNotFinite));

    let mut absurd = good(3);
    absurd.angles[Joint::WaistPitch] = 40.0;
    assert!(controller.tick(PERIOD, Some(&absurd)).report.faults.contains(Fault::MeasurementImplausible));

    assert_eq!(controller.tick(PERIOD, Some(&good(5))).report.faults.0, 0);
    let faults = controller.tick(PERIOD, Some(&good(4))).report.faults;
    assert!(faults.contains(Fault::MeasurementOutOfOrder));
}

/// Silence, and the same sample again and again, end the walk at the next support change.
#[test]
fn missing_or_repeated_measurements_end_the_walk() {
    for frozen in [None, Some(good(3))] {
        let mut controller = controller();
        controller.tick(PERIOD, Some(&good(3)));
        let mut stale_after = None;
        let mut mode = Mode::Walking;
        for tick in 0..3000 {
            let report = controller.tick(PERIOD, frozen.as_ref());
            if report.report.faults.contains(Fault::MeasurementStale) {
                stale_after = stale_after.or(Some(tick));
            }
            mode = report.report.mode;
        }
        assert!(stale_after.is_some_and(|tick| (98..=102).contains(&tick)), "noticed after {stale_after:?} periods");
        assert_eq!(mode, Mode::Faulted);
    }
}

/// A robot that lies is left alone.
#[test]
fn a_fallen_robot_is_not_moved() {
    let mut controller = controller();
    let orientation = Quaternion::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt(), 0.0);
    let mut lie = |tick| controller.tick(PERIOD, Some(&Measurement { orientation, ..good(tick) }));
    let fallen_after = (0..100).find(|tick| lie(*tick).report.mode == Mode::Fallen);
    assert!(fallen_after.is_some_and(|tick| (45..60).contains(&tick)), "believed after {fallen_after:?} periods");
    let first = lie(100);
    assert!(first.report.faults.contains(Fault::Fallen));
    for tick in 101..150 {
        let report = controller.tick(PERIOD, Some(&good(tick)));
        assert_eq!((report.report.mode, report.setpoint), (Mode::Fallen, first.setpoint));
    }
}
