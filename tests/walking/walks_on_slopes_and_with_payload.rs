//! The robot walks on slopes of 2° whichever way they rise, with links 5 % heavier or lighter than it knows, with 5 kg
//! that it does not know of, on a slippery floor and with sensors that come late.
//!
//! Method: the plant is other than the controller believes, in one respect at a time; a walk in lockstep at every
//! corner of c 0.7 to 1.3 and α ±15°, the corners shared among the respects.

use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{GaitChange, Mode};
use plant::PlantParameters;

const SECONDS: f64 = 12.0;
/// Turn (°) and speed factor.
const CORNERS: [[f64; 2]; 4] = [[15.0, 0.7], [-15.0, 1.3], [15.0, 1.3], [-15.0, 0.7]];

fn assert_walks(what: &str, corner: [f64; 2], change: impl Fn(&mut PlantParameters)) {
    let mut parameters = plant_parameters();
    change(&mut parameters);
    let mut walking = Walking::begin_with(&mechanism(), &controller_parameters(), &parameters, 1);
    let request = GaitChange { turn: Some(corner[0].to_radians()), speed: Some(corner[1]), ..GaitChange::NONE };
    walking.walk(1.0);
    walking.tick(Some((&request, None)));
    let truth = walking.walk(SECONDS);
    let mode = walking.tick(None).report.mode;
    assert!(!truth.has_fallen() && mode == Mode::Walking, "{what}, {corner:?}: fell by {:.1} s", walking.time());
}

#[test]
fn walks_on_a_slope() {
    let rises = [[2.0_f64, 0.0], [-2.0, 0.0], [0.0, 2.0], [0.0, -2.0]];
    for (index, rise) in rises.into_iter().enumerate() {
        for corner in [CORNERS[index], CORNERS[(index + 1) % 4]] {
            assert_walks(&format!("on a slope of {rise:?}°"), corner, |plant| {
                [plant.slope.ahead, plant.slope.left] = rise.map(f64::to_radians);
            });
        }
    }
}

#[test]
fn walks_with_5_kg_and_with_links_of_another_mass() {
    for corner in &CORNERS[..2] {
        assert_walks("with a payload", *corner, |plant| plant.payload.mass = 5.0);
    }
    for corner in &CORNERS[2..] {
        assert_walks("with other masses", *corner, |plant| plant.mass_error = 0.05);
    }
}

#[test]
fn walks_on_a_slippery_floor_and_with_late_sensors() {
    for corner in &CORNERS[..2] {
        assert_walks("on a slippery floor", *corner, |plant| plant.contact.friction = 0.5);
    }
    for corner in &CORNERS[2..] {
        assert_walks("with late sensors", *corner, |plant| plant.sensors.delay_periods = 3);
    }
}
