//! On tiles that lie up to 2 mm higher or lower than the floor, so that soles land early, late, and on edges of 4 mm,
//! the robot walks on: a leg gives way or reaches, and the ankle takes out what the measured ZMP misses. Without both
//! it falls on most floors of 10 mm, and with both on none.

use controller::Parameters;
use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{GaitChange, Mode};
use plant::Unevenness;

/// Whether it still walks after some seconds on tiles of a height and a size (m).
fn walks(controller: &Parameters, [height, tile]: [f64; 2], request: GaitChange, seed: u64) -> bool {
    let mut plant = plant_parameters();
    plant.unevenness = Unevenness { height, tile };
    let mut walking = Walking::begin_with(&mechanism(), controller, &plant, seed);
    walking.ask(request, None);
    let upright = !walking.walk(15.0).has_fallen();
    upright && walking.tick(None).report.mode == Mode::Walking
}

#[test]
fn walks_on_uneven_tiles() {
    let requests = [
        GaitChange::default(),
        GaitChange { speed: Some(0.7), turn: Some(0.26), ..GaitChange::default() },
        GaitChange { speed: Some(1.3), turn: Some(-0.26), ..GaitChange::default() },
    ];
    for (seed, request) in requests.into_iter().enumerate() {
        for tile in [0.3, 1.0] {
            assert!(
                walks(&controller_parameters(), [0.002, tile], request, seed as u64),
                "{tile} m tiles, {request:?}: fell"
            );
        }
    }
}

/// Tiles that steps alone do not cope with (m), and how many floors of them are tried.
const HIGH: [f64; 2] = [0.010, 0.3];
const FLOORS: u64 = 12;

#[test]
fn falls_on_uneven_tiles_with_stiff_legs_and_blind_ankles() {
    let mut stiff = controller_parameters();
    stiff.stabilizer.landing.damping = 1e9;
    stiff.stabilizer.feedback.foot_damping_time_constant = 1e6;
    let falls =
        |controller| (0..FLOORS).filter(|seed| !walks(controller, HIGH, GaitChange::default(), *seed)).count() as u64;
    let stiff_falls = falls(&stiff);
    assert!(stiff_falls >= FLOORS / 2, "stiff legs and blind ankles fell on {stiff_falls} floors");
    assert_eq!(falls(&controller_parameters()), 0);
}
