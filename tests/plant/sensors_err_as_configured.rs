//! Goal: rate, delay, mounting and bias of the sensors are those of their parameters, and the accelerometer tells what
//! the trunk does.

use halfstep_tests::mechanism;
use halfstep_tests::walking::plant_parameters;
use interface::{Measurement, Setpoint};
use model::{GRAVITY, Joint, Motion};
use nalgebra::{UnitQuaternion, Vector3};
use plant::{Plant, SensorParameters};

const PERIOD: f64 = 1e-3;

/// Samples of a robot that bends its waist and knees, with these sensors; and the true velocity of the trunk's origin.
fn samples(sensors: SensorParameters) -> Vec<Measurement> {
    let parameters = plant::PlantParameters { sensors, ..plant_parameters() };
    let mut plant = Plant::new(&mechanism(), &parameters, &Motion::default(), PERIOD, 5);
    let mut setpoint = Setpoint::default();
    setpoint.angles[Joint::LeftKnee] = 0.5;
    setpoint.angles[Joint::WaistPitch] = 0.2;
    std::iter::once(plant.measure()).chain((1..200).map(|_| plant.step(&setpoint))).collect()
}

#[test]
fn a_sample_comes_every_so_many_periods_and_is_repeated_with_its_number() {
    let perfect = samples(SensorParameters::PERFECT);
    for delay_periods in [0, 1, 4] {
        let slow = samples(SensorParameters { every_periods: 3, delay_periods, ..SensorParameters::PERFECT });
        for number in 10..200_u64 {
            let taken = (number - u64::from(delay_periods)) / 3 * 3;
            let arrived = taken + u64::from(delay_periods);
            let expected = Measurement { sample: arrived, ..perfect[taken as usize] };
            assert_eq!(slow[number as usize], expected, "period {number}, {delay_periods} periods late");
        }
    }
}

#[test]
fn a_unit_that_is_mounted_askew_tells_all_in_its_own_axes() {
    let perfect = samples(SensorParameters::PERFECT);
    let mounting = Vector3::new(0.02, -0.01, 0.1);
    let gyro_bias = Vector3::new(0.01, 0.02, -0.03);
    let askew = samples(SensorParameters { mounting, gyro_bias, ..SensorParameters::PERFECT });
    let turned = UnitQuaternion::from_euler_angles(mounting.x, mounting.y, mounting.z);
    for (askew, perfect) in askew.iter().zip(&perfect) {
        let orientation = UnitQuaternion::new_unchecked(perfect.orientation) * turned;
        assert!((askew.orientation.coords - orientation.coords).norm() < 1e-12);
        assert!((turned * (askew.angular_rate - gyro_bias) - perfect.angular_rate).norm() < 1e-12);
        assert!((turned * askew.specific_force - perfect.specific_force).norm() < 1e-12);
        assert_eq!((askew.angles, askew.feet), (perfect.angles, perfect.feet));
    }
}

#[test]
fn an_accelerometer_at_rest_tells_gravity_and_in_motion_the_change_of_velocity() {
    let still = {
        let parameters = plant::PlantParameters { sensors: SensorParameters::PERFECT, ..plant_parameters() };
        Plant::new(&mechanism(), &parameters, &Motion::default(), PERIOD, 5).measure()
    };
    assert!((still.specific_force - Vector3::z() * GRAVITY).norm() < 1e-9, "{}", still.specific_force);
    // Levelled and without gravity the accelerations sum up to a velocity: bending stops after a while.
    let samples = samples(SensorParameters::PERFECT);
    let level = |sample: &Measurement| {
        UnitQuaternion::new_unchecked(sample.orientation) * sample.specific_force - Vector3::z() * GRAVITY
    };
    let largest = samples.iter().map(|sample| level(sample).norm()).fold(0.0, f64::max);
    let velocity: Vector3<f64> = samples[1..].iter().map(|sample| level(sample) * PERIOD).sum();
    assert!(largest > 0.5, "it moves: {largest} m/s²");
    let truth = {
        let parameters = plant::PlantParameters { sensors: SensorParameters::PERFECT, ..plant_parameters() };
        let mut plant = Plant::new(&mechanism(), &parameters, &Motion::default(), PERIOD, 5);
        let mut setpoint = Setpoint::default();
        setpoint.angles[Joint::LeftKnee] = 0.5;
        setpoint.angles[Joint::WaistPitch] = 0.2;
        (1..200).for_each(|_| {
            plant.step(&setpoint);
        });
        let (mechanism, tree) = (mechanism(), dynamics::Tree::new(&mechanism()));
        let kinematics = plant.robot.kinematics(&tree);
        let trunk = model::Mechanism::TRUNK;
        plant.robot.link_velocity(&tree, &mechanism, &kinematics, trunk, kinematics.origin[trunk]).1
    };
    assert!((velocity - truth).norm() < 1e-9, "{velocity} instead of {truth}");
}
