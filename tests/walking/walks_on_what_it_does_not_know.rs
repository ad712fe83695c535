//! The floor's friction, the masses, the load, the servos and the sensors' delay may be other than the controller
//! believes.
//! `cargo run --release -p halfstep-survey -- variations` walks longer and by more commands.

use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{GaitChange, Intent, Mode};
use nalgebra::Vector3;
use plant::{Payload, PlantParameters};

const SECONDS: f64 = 8.0;

/// Walks fast to the left and slowly to the right.
fn assert_walks(what: &str, change: impl Fn(&mut PlantParameters)) {
    let mut parameters = plant_parameters();
    change(&mut parameters);
    for (speed, turn) in [(1.3, 15_f64), (0.7, -15_f64)] {
        let mut walking = Walking::begin_with(&mechanism(), &controller_parameters(), &parameters, 3);
        let request = GaitChange { turn: Some(turn.to_radians()), speed: Some(speed), ..GaitChange::NONE };
        walking.ask(request, Some(Intent::Walk));
        let fallen = walking.walk(SECONDS).has_fallen();
        let mode = walking.tick(None).report.mode;
        assert!(!fallen && mode == Mode::Walking, "{what}: fell by {request:?} before {:.1} s", walking.time());
    }
}

#[test]
fn walks_on_a_smooth_floor_it_does_not_know() {
    assert_walks("friction 0.5", |plant| plant.contact.friction = 0.5);
}

#[test]
fn walks_with_masses_it_does_not_know() {
    assert_walks("masses ±5 %", |plant| plant.mass_error = 0.05);
}

#[test]
fn walks_with_servos_it_does_not_know() {
    for stiffness in [0.7, 1.4] {
        assert_walks(&format!("servos of {stiffness} the stiffness"), |plant| plant.servo.stiffness = stiffness);
    }
}

#[test]
fn walks_with_a_payload_it_does_not_know() {
    assert_walks("5 kg high", |plant| plant.payload = Payload { mass: 5.0, at: Vector3::new(0.0, 0.0, 0.5) });
    assert_walks("5 kg aside", |plant| plant.payload = Payload { mass: 5.0, at: Vector3::new(0.0, 0.15, 0.28) });
}

#[test]
fn walks_with_a_sensor_delay_it_does_not_know() {
    assert_walks("3 ms late", |plant| plant.sensors.delay_periods = 3);
}
