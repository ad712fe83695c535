//! Sensors whose values are plausible and wrong for good are noticed: the robot stops with a latched fault before it
//! falls, or in any case does not walk on as if nothing had happened. Clean walks raise no alarm.
//!
//! Method: the nominal walk in lockstep; each fault begins at two phases of the half-step and lasts for good. `survey
//! faults` has the whole matrix: shorter faults, more phases, a robot that stands, MuJoCo.

use config::Config;
use halfstep_tests::pushing::{Direction, PUSH_DURATION};
use halfstep_tests::random;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{Fault, Faults, GaitChange, Intent, Mode, Reason, Sensor};
use model::{Joint, Side};
use plant::Disturbances;
use rand::Rng;

/// Longest time until a fault is noticed (s).
const NOTICED_WITHIN: f64 = 0.4;
/// What a fault of a sensor is noticed by.
const ALARMS: [Fault; 6] = [
    Fault::MeasurementImplausible,
    Fault::MeasurementFrozen,
    Fault::MeasurementInconsistent,
    Fault::JointOffSetpoint,
    Fault::OrientationAskew,
    Fault::MeasurementStale,
];

const HIP_ROLL: &str = "values = \"angles\"\njoint = \"right_hip_roll\"";
const KNEE_RATE: &str = "values = \"rates\"\njoint = \"left_knee\"";

/// Lines of a script, and the sensor that is named when the fault is noticed.
fn faults() -> Vec<(String, Sensor)> {
    let (hip, knee) = (Sensor::JointAngle(Joint::RightHipRoll), Sensor::JointRate(Joint::LeftKnee));
    let of = |kind: &str, values: &str, size: &str| format!("kind = \"{kind}\"\n{values}\n{size}");
    let values = |group: &str| format!("values = \"{group}\"");
    vec![
        (of("freeze", &values("orientation"), ""), Sensor::Orientation),
        (of("freeze", &values("angular_rate"), ""), Sensor::AngularRate),
        (of("freeze", &values("feet"), ""), Sensor::Foot(Side::Right)),
        (of("freeze", KNEE_RATE, ""), knee),
        (of("reverse", HIP_ROLL, ""), hip),
        (of("reverse", KNEE_RATE, ""), knee),
        (of("swap", &values("feet"), ""), Sensor::Feet),
        (of("swap", HIP_ROLL, ""), hip),
        (of("saturate", &values("feet"), "size_n = 50"), Sensor::Feet),
        (of("spike", HIP_ROLL, "size_deg = 2"), hip),
        (of("spike", HIP_ROLL, "size_deg = -10"), hip),
        (of("spike", KNEE_RATE, "size_deg_per_s = 30"), knee),
        (of("spike", &values("orientation"), "size_deg = 3"), Sensor::Orientation),
        (of("spike", &values("feet"), "size_n = 2000"), Sensor::Feet),
    ]
}

#[test]
fn every_lasting_sensor_fault_is_named_and_ends_the_walk() {
    for (fault, sensor) in faults() {
        for phase in 0..2 {
            let start = 2.48 + 0.3 * f64::from(phase);
            let script = format!("[[sensor_fault]]\nat_s = {start}\nlasts_s = 60\n{fault}");
            let mut walking = Walking::begin(1);
            walking.plant.disturbances = Disturbances::from_toml(&script, "script").unwrap();
            walking.walk(start);
            let mut noticed = None;
            let mut mode = Mode::Walking;
            while walking.time() < start + 4.0 {
                let tick = walking.tick(None);
                mode = tick.report.mode;
                if noticed.is_none() && is_alarm(tick.report.faults) && mode != Mode::Fallen {
                    noticed = Some((walking.time() - start, tick.rejection));
                }
            }
            let (after, rejection) = noticed.unwrap_or_else(|| panic!("`{fault}` from {start} s was not noticed"));
            assert!(after < NOTICED_WITHIN, "`{fault}` from {start} s: noticed after {after} s");
            let named = rejection.map(|rejection| rejection.sensor);
            let is_either_foot = matches!((named, sensor), (Some(Sensor::Foot(_)), Sensor::Foot(_)));
            assert!(named == Some(sensor) || is_either_foot, "`{fault}` from {start} s: {named:?}");
            assert!(matches!(mode, Mode::Faulted | Mode::Fallen), "`{fault}` from {start} s: {mode:?}");
        }
    }
}

/// An orientation that is off from the start contradicts nothing but the way the robot stands. It does not set out.
#[test]
fn a_robot_whose_orientation_was_always_askew_says_so_and_stays() {
    for degrees in [-3, -2, 2, 3] {
        let script = format!(
            "[[sensor_fault]]\nat_s = 0\nlasts_s = 60\nkind = \"spike\"\nvalues = \"orientation\"\n\
             size_deg = {degrees}"
        );
        let mut walking = Walking::stand(1);
        walking.plant.disturbances = Disturbances::from_toml(&script, "script").unwrap();
        walking.walk(0.1);
        walking.ask(GaitChange::NONE, Some(Intent::Walk));
        walking.walk(1.0);
        let latched = walking.tick(None).latched.map(|latched| latched.fault);
        assert_eq!(latched, Some(Fault::OrientationAskew), "{degrees}°");
        assert!(!walking.walk(6.0).has_fallen(), "{degrees}°");
        let tick = walking.tick(None);
        assert_eq!((tick.report.mode, tick.report.half_step.index), (Mode::Faulted, 0), "{degrees}°");
    }
}

/// An orientation that is off for good cannot be told from a repaired one: the operator decides, by a second reset.
#[test]
fn a_second_reset_takes_sensors_as_they_are() {
    let mut walking = Walking::begin(1);
    let script = "[[sensor_fault]]\nat_s = 2\nlasts_s = 60\nkind = \"spike\"\nvalues = \"orientation\"\nsize_deg = 1";
    walking.plant.disturbances = Disturbances::from_toml(script, "script").unwrap();
    walking.walk(6.0);
    assert_eq!(walking.tick(None).report.mode, Mode::Faulted);
    let mut reset = || walking.ask(GaitChange::NONE, Some(Intent::Reset)).reply.map(|reply| reply.reason);
    assert_eq!(reset(), Some(Reason::FaultPersists));
    assert_eq!(reset(), Some(Reason::None));
    walking.walk(8.0);
    assert!(!walking.plant.truth().has_fallen());
}

/// Frozen forces do most harm around a support change: they are tried every 20 ms of a half-step.
#[test]
fn frozen_sensors_for_a_fifth_of_a_second_fell_nobody_at_any_phase() {
    for fault in ["kind = \"freeze\"\nvalues = \"feet\"", "kind = \"freeze\""] {
        for onset in 0..30 {
            let start = 2.4 + 0.02 * onset as f64;
            let script = format!("[[sensor_fault]]\nat_s = {start}\nlasts_s = 0.2\n{fault}");
            let mut walking = Walking::begin(onset);
            walking.plant.disturbances = Disturbances::from_toml(&script, "script").unwrap();
            assert!(!walking.walk(start + 3.0).has_fallen(), "`{fault}` from {start} s");
        }
    }
}

/// Half the samples are missing: what is not measured is extrapolated, and the robot bears a push all the same.
#[test]
fn sensors_at_half_the_rate_bear_the_same_push() {
    for (direction, impulse) in [(Direction::Forward, 15.0), (Direction::ToSwing, 6.0)] {
        let script = "[[sensor_fault]]\nat_s = 1\nlasts_s = 60\nkind = \"half_rate\"";
        let mut walking = Walking::begin(1);
        walking.plant.disturbances = Disturbances::from_toml(script, "script").unwrap();
        walking.walk(3.1);
        let support = walking.tick(None).report.half_step.support;
        let push = direction.in_world(&walking, support) * impulse;
        walking.plant.push(push, PUSH_DURATION);
        assert!(!walking.walk(6.0).has_fallen(), "{direction:?}");
        assert_eq!(walking.tick(None).report.mode, Mode::Walking, "{direction:?}");
    }
}

fn is_alarm(faults: Faults) -> bool {
    ALARMS.into_iter().any(|fault| faults.contains(fault))
}

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
                sidestep: Some(random.random_range(-limits.sidestep_max..=limits.sidestep_max)),
            };
            let report = walking.tick((tick % 1500 == 700).then_some((&change, None))).report;
            assert!(!is_alarm(report.faults), "seed {seed}, tick {tick}");
        }
    }
}

#[test]
fn no_alarm_is_raised_by_tiles_slopes_and_pushes() {
    let mut tiles = plant_parameters();
    tiles.unevenness.height = 0.002;
    let mut slope = plant_parameters();
    slope.slope.left = 2_f64.to_radians();
    for (plant, is_pushed) in [(tiles, false), (slope, false), (plant_parameters(), true)] {
        let mut walking = Walking::begin_with(&halfstep_tests::mechanism(), &controller_parameters(), &plant, 0);
        for tick in 0..30_000 {
            let report = walking.tick(None).report;
            assert!(!is_alarm(report.faults), "tick {tick}: {:?}", report.faults.iter().collect::<Vec<_>>());
            if is_pushed && tick % 5000 == 4100 {
                let push = Direction::ToSwing.in_world(&walking, report.half_step.support) * 6.0;
                walking.plant.push(push, PUSH_DURATION);
            }
        }
    }
}

#[test]
fn no_alarm_is_raised_in_a_stand_on_tiles_and_slopes_that_is_pushed() {
    let floors: [fn(&mut plant::PlantParameters); 5] = [
        |_| {},
        |plant| plant.unevenness.height = 0.002,
        |plant| plant.slope.ahead = 2_f64.to_radians(),
        |plant| plant.slope.ahead = -2_f64.to_radians(),
        |plant| plant.slope.left = 2_f64.to_radians(),
    ];
    for (number, floor) in floors.into_iter().enumerate() {
        let mut plant = plant_parameters();
        floor(&mut plant);
        for intent in [Intent::Stop, Intent::Hold] {
            let mut walking = Walking::begin_with(&halfstep_tests::mechanism(), &controller_parameters(), &plant, 0);
            walking.walk(2.0);
            walking.ask(GaitChange::NONE, Some(intent));
            walking.walk(4.0);
            for direction in Direction::ALL {
                let support = walking.tick(None).report.half_step.support;
                let push = direction.in_world(&walking, support) * 8.0;
                walking.plant.push(push, PUSH_DURATION);
                for _ in 0..3000 {
                    let report = walking.tick(None).report;
                    assert!(!is_alarm(report.faults), "floor {number}, {intent:?}, {:.2} s", walking.time());
                }
            }
            assert!(!walking.plant.truth().has_fallen(), "floor {number}, {intent:?}");
        }
    }
}
