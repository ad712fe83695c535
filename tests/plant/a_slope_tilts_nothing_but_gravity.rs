//! Goal: on a slope gravity is not normal to the floor, and everything follows from that.
//!
//! Method: a robot at rest is held by a vertical force; its inertial measurement unit sees the slope and no turn; with
//! little friction it stands below the friction angle and slides above it as a block does.

use halfstep_tests::mechanism;
use halfstep_tests::walking::plant_parameters;
use interface::{Measurement, Setpoint};
use model::{GRAVITY, Motion, Side};
use nalgebra::{UnitQuaternion, Vector3};
use plant::{ContactParameters, Plant, PlantParameters, SensorParameters, Slope};

fn on_a_slope(ahead_deg: f64, left_deg: f64, friction: f64) -> Plant {
    let parameters = PlantParameters {
        slope: Slope { ahead: ahead_deg.to_radians(), left: left_deg.to_radians() },
        contact: ContactParameters { friction, ..plant_parameters().contact },
        sensors: SensorParameters::PERFECT,
        ..plant_parameters()
    };
    Plant::new(&mechanism(), &parameters, &Motion::default(), 1e-3, 1)
}

fn stand(plant: &mut Plant, seconds: u32) -> Measurement {
    for _ in 1..1000 * seconds {
        plant.step(&Setpoint::default());
    }
    plant.step(&Setpoint::default())
}

#[test]
fn on_a_slope_the_ground_force_is_vertical_and_the_imu_measures_the_slope() {
    for (ahead, left) in [(0.0_f64, 0.0_f64), (2.0, 0.0), (0.0, 2.0), (-2.0, 1.0), (1.5, -2.0)] {
        let mut plant = on_a_slope(ahead, left, 0.8);
        let sensed = stand(&mut plant, 4);
        let truth = plant.truth();
        let up = Slope { ahead: ahead.to_radians(), left: left.to_radians() }.up();

        let ground: Vector3<f64> =
            Side::BOTH.map(|side| truth.soles[side.index()].rotation * sensed.feet[side.index()].force).iter().sum();
        let weight = mechanism().mass() * GRAVITY;
        assert!((ground - up * weight).norm() < 2e-3 * weight, "{ahead}° {left}°: {ground} N");
        assert!(ground.normalize().angle(&up) < 1e-3, "{ahead}° {left}°: {ground} N is not vertical");

        // The joints give way by a few tenths of a degree; the soles stay flat on the floor.
        let orientation = UnitQuaternion::new_unchecked(sensed.orientation);
        let up_in_trunk = orientation.inverse() * Vector3::z();
        assert!(up_in_trunk.angle(&up) < 0.006, "{ahead}° {left}°: the trunk feels {up_in_trunk}");
        let heading = orientation * Vector3::x();
        assert!(heading.y.atan2(heading.x).abs() < 0.001, "{ahead}° {left}°: it heads to {heading}");
        assert!((truth.trunk_tilt - up_in_trunk.z.acos()).abs() < 1e-6);
        assert!(sensed.angles.0[..2].iter().all(|tilt| tilt.abs() < 0.001), "{:?}", sensed.angles);
    }
}

/// The friction angle of 0.03 is 1.72°.
#[test]
fn a_robot_stands_on_a_slope_below_the_friction_angle() {
    let mut plant = on_a_slope(0.0, 1.5, 0.03);
    stand(&mut plant, 1);
    let before = plant.truth();
    stand(&mut plant, 2);
    let after = plant.truth();
    assert!((after.com - before.com).norm() < 2e-4, "slid from {} to {}", before.com, after.com);
}

#[test]
fn a_robot_slides_like_a_block_on_a_slope_above_the_friction_angle() {
    let mut plant = on_a_slope(0.0, 2.5, 0.03);
    stand(&mut plant, 1);
    let before = plant.truth().com_velocity;
    stand(&mut plant, 1);
    let gained = plant.truth().com_velocity - before;
    let angle = 2.5_f64.to_radians();
    let expected = -GRAVITY * (angle.sin() - 0.03 * angle.cos());
    assert!((gained.y - expected).abs() < 0.01 * expected.abs(), "{} m/s² instead of {expected} m/s²", gained.y);
    assert!(gained.x.abs() < 0.01 * expected.abs());
}
