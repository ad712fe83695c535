//! The tick allocates nothing: walking, swapping feet, answering requests, braking, standing, and with bad
//! measurements. Nor does the plant's step, whatever happens to the robot.
//!
//! Method: an allocator that counts what this thread asks of it.

use config::Config;
use halfstep_tests::counting::allocations;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use halfstep_tests::{mechanism, repository};
use interface::{GaitChange, Intent, Setpoint};
use model::{Mechanism, Motion};
use plant::Plant;

use crate::alone;

fn allocations_of(work: impl FnOnce()) -> u64 {
    let before = allocations();
    work();
    allocations() - before
}

#[test]
fn ticks_never_allocate_whatever_is_requested() {
    let _alone = alone();
    assert!(allocations_of(|| drop(std::hint::black_box(vec![1]))) > 0, "the allocator does not count");

    let mut walking = Walking::begin(1);
    let change = GaitChange { turn: Some(0.05), speed: Some(1.05), extension: Some(0.03), sidestep: Some(0.1) };
    let nonsense = GaitChange { turn: Some(f64::NAN), speed: Some(9.0), ..GaitChange::NONE };
    let count = allocations_of(|| {
        for tick in 0..6000 {
            let request = match tick {
                500 => Some((&change, None)),
                900 => Some((&nonsense, None)),
                3000 => Some((&change, Some(Intent::Hold))),
                5000 => Some((&change, Some(Intent::Walk))),
                _ => None,
            };
            walking.tick(request);
        }
        for _ in 0..100 {
            walking.driver.controller.tick(1e-3, None);
        }
    });
    assert_eq!(count, 0, "in 6100 ticks of controller and plant");
}

#[test]
fn ticks_never_allocate_whatever_happens_to_the_robot() {
    let _alone = alone();
    let script = "[[push]]\nat_s = 0.1\nlasts_s = 0.2\nimpulse_n_s = [1, 2, 3]\nlink = \"left_foot\"\n\
                  [[push]]\nat_s = 0.2\nlasts_s = 0.2\nimpulse_n_s = [300, 2, 3]\n\
                  [[sensor_fault]]\nat_s = 0.1\nlasts_s = 0.1\nkind = \"delay\"\ndelay_periods = 31\n\
                  [[sensor_fault]]\nat_s = 0.15\nlasts_s = 0.2\nkind = \"nan\"\n";
    let parameters = plant::PlantParameters {
        payload: plant::Payload { mass: 5.0, at: Default::default() },
        mass_error: 0.05,
        ..plant_parameters()
    };
    let mut walking = Walking::begin_with(&mechanism(), &controller_parameters(), &parameters, 1);
    walking.plant.disturbances = plant::Disturbances::from_toml(script, "script").expect("it is good");
    let count = allocations_of(|| {
        for _ in 0..1000 {
            walking.tick(None);
        }
    });
    assert_eq!(count, 0, "in 1000 ticks of controller and plant");
}

/// Held joints turn in the plant only.
#[test]
fn steps_with_held_joints_never_allocate() {
    let _alone = alone();
    let file = repository().join("config/robots/talos/mechanism.toml");
    let mechanism = Mechanism::load(file).unwrap_or_else(|errors| panic!("{errors}"));
    let mut plant = Plant::new(&mechanism, &plant_parameters(), &Motion::default(), 1e-3, 1);
    assert!(plant.robot.held.rates.len() > 10);
    let count = allocations_of(|| {
        for _ in 0..300 {
            plant.step(&Setpoint::default());
            plant.hold();
            std::hint::black_box((plant.truth(), plant.instability()));
        }
    });
    assert_eq!(count, 0, "in 300 periods of the plant");
}
