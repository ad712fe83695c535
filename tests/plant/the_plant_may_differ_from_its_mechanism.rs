//! Goal: a payload and errors of mass are in the plant and nowhere else.
//!
//! Method: the ground carries what is there; a payload at the trunk's centre of mass is a heavier trunk, whatever the
//! robot does; without an error nothing differs by a bit.

use dynamics::{Kinematics, Tree};
use halfstep_tests::mechanism;
use halfstep_tests::walking::plant_parameters;
use interface::Setpoint;
use model::{GRAVITY, Joint, JointVector, Mechanism, Motion};
use nalgebra::Vector3;
use plant::{Payload, Plant, PlantParameters, Truth, with_mass_error};

fn plant(mechanism: &Mechanism, parameters: &PlantParameters, seed: u64) -> Plant {
    Plant::new(mechanism, parameters, &Motion::default(), 1e-3, seed)
}

/// At rest on both feet.
fn standing(parameters: &PlantParameters, seed: u64) -> Truth {
    let mut plant = plant(&mechanism(), parameters, seed);
    for _ in 0..3000 {
        plant.step(&Setpoint::default());
    }
    plant.truth()
}

#[test]
fn the_ground_carries_the_payload() {
    let payload = Payload { mass: 5.0, at: Vector3::new(0.05, 0.08, 0.3) };
    let carrying = standing(&PlantParameters { payload, ..plant_parameters() }, 1);
    let empty = standing(&plant_parameters(), 1);

    let heavier = carrying.loads.iter().sum::<f64>() - empty.loads.iter().sum::<f64>();
    assert!((heavier - 5.0 * GRAVITY).abs() < 1e-3 * 5.0 * GRAVITY, "{heavier} N");

    // To a few tenths of a millimetre, by which the joints give way.
    let mass = mechanism().mass();
    let trunk = Kinematics::fixed_base(&Tree::new(&mechanism()), &JointVector::ZERO).origin[Joint::WaistRoll];
    let expected = (empty.com * mass + (trunk + payload.at) * payload.mass) / (mass + payload.mass);
    assert!((carrying.com - expected).norm() < 1e-3, "{} instead of {expected}", carrying.com);
    assert!(carrying.com.y - empty.com.y > 0.004, "it moved to the left");
    let zmp = carrying.zmp.expect("it stands");
    assert!((zmp - carrying.com.xy()).norm() < 1e-4, "ZMP {zmp} is not under {}", carrying.com);
}

/// In flight and swinging its limbs, so that gravity, inertia and every velocity product count.
#[test]
fn a_payload_at_the_trunks_centre_of_mass_is_a_heavier_trunk() {
    let light = mechanism();
    let mut heavy = mechanism();
    heavy.links[Joint::WaistRoll].body.mass += 6.0;
    let payload = Payload { mass: 6.0, at: light.links[Joint::WaistRoll].body.com };
    let mut carries = plant(&light, &PlantParameters { payload, ..plant_parameters() }, 1);
    let mut weighs = plant(&heavy, &plant_parameters(), 1);
    for plant in [&mut carries, &mut weighs] {
        plant.robot.sole_to_world.translation.vector.z = 5.0;
        plant.robot.angular_rate = Vector3::new(2.0, -3.0, 1.5);
        plant.robot.velocity = Vector3::new(1.0, 2.0, 3.0);
    }
    let mut setpoint = Setpoint::default();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        setpoint.angles[joint] = if joint.index() % 2 == 0 { 0.3 } else { -0.4 };
    }
    for _ in 0..400 {
        carries.step(&setpoint);
        weighs.step(&setpoint);
    }
    let (one, other) = (&carries.robot, &weighs.robot);
    assert!((one.rates - other.rates).max_abs() < 1e-8, "{:?}\n{:?}", one.rates, other.rates);
    assert!((one.velocity - other.velocity).norm() < 1e-8);
    assert!((one.angular_rate - other.angular_rate).norm() < 1e-8);
    let (one, other) = (carries.truth(), weighs.truth());
    assert!((one.com - other.com).norm() < 1e-9 && (one.com_velocity - other.com_velocity).norm() < 1e-9);
    assert!((one.com_velocity - Vector3::new(1.0, 2.0, 3.0)).norm() > 1.0, "it turned and fell");
}

#[test]
fn the_seed_decides_the_errors_of_mass() {
    let wrong = PlantParameters { mass_error: 0.05, ..plant_parameters() };
    let carried = |seed| standing(&wrong, seed).loads.iter().sum::<f64>();
    let weight = |seed| with_mass_error(&mechanism(), 0.05, seed).mass() * GRAVITY;
    let (first, second) = (carried(1), carried(2));
    assert_eq!(first, carried(1), "the same seed, the same robot");
    assert!((first - weight(1)).abs() < 1e-3 * weight(1) && (second - weight(2)).abs() < 1e-3 * weight(2));
    assert!((weight(1) - weight(2)).abs() > 0.002 * weight(1), "another seed, another robot");
}
