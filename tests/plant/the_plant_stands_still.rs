//! With its drives holding a posture the robot stands on both feet for ten seconds and does not creep.

use halfstep_tests::mechanism;
use halfstep_tests::walking::plant_parameters;
use interface::Setpoint;
use model::{GRAVITY, Motion};
use nalgebra::UnitQuaternion;
use plant::{Plant, PlantParameters, SensorParameters};

#[test]
fn the_plant_stands_still_for_ten_seconds() {
    let mechanism = mechanism();
    let mut plant = Plant::new(&mechanism, &plant_parameters(), &Motion::default(), 1e-3, 1);
    let settle = |plant: &mut Plant, periods: u32| {
        for _ in 0..periods {
            plant.step(&Setpoint::default());
        }
        plant.truth()
    };
    let settled = settle(&mut plant, 1000);
    let later = settle(&mut plant, 9000);

    assert!(!later.has_fallen());
    assert!((later.com - settled.com).norm() < 1e-4, "moved by {} m", (later.com - settled.com).norm());
    let sole_moved = (later.soles[0].translation.vector - settled.soles[0].translation.vector).norm();
    assert!(sole_moved < 1e-5, "the right sole crept by {sole_moved} m");
    let weight = mechanism.mass() * GRAVITY;
    assert!((later.loads[0] + later.loads[1] - weight).abs() < 1e-3 * weight);
    let zmp = later.zmp.expect("it stands");
    assert!((zmp - later.com.xy()).norm() < 1e-4, "ZMP {zmp} is not under the centre of mass {}", later.com);
}

/// The sensors carry the weight too: both soles' vertical forces add up to it, and the trunk is upright.
#[test]
fn sensors_of_a_standing_plant_measure_its_weight_and_an_upright_trunk() {
    let mechanism = mechanism();
    let parameters = PlantParameters { sensors: SensorParameters::PERFECT, ..plant_parameters() };
    let mut plant = Plant::new(&mechanism, &parameters, &Motion::default(), 1e-3, 1);
    let mut measured = plant.measure();
    for _ in 0..2000 {
        measured = plant.step(&Setpoint::default());
    }
    let weight = mechanism.mass() * GRAVITY;
    let sensed = measured.feet[0].force.z + measured.feet[1].force.z;
    assert!((sensed - weight).abs() < 1e-3 * weight, "{sensed} N of {weight} N");
    assert!(UnitQuaternion::new_unchecked(measured.orientation).angle() < 0.02);
    assert!(measured.angular_rate.norm() < 1e-3);
}
