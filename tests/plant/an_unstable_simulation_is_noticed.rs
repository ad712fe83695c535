//! Goal: a simulated robot that has left physics is noticed before its numbers mean nothing, and the settings that did
//! it are named. What files may hold keeps the integration stable, so the settings are made here.

use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use plant::Unevenness;

#[test]
fn a_floor_of_tiles_as_high_as_a_house_is_named_or_keeps_its_numbers() {
    for height in [2.0, 20.0, 1e6, 1e300] {
        let mut parameters = plant_parameters();
        parameters.unevenness = Unevenness { height, ..parameters.unevenness };
        let mut walking = Walking::begin_with(&halfstep_tests::mechanism(), &controller_parameters(), &parameters, 1);
        let unstable = (0..6000).find_map(|_| {
            walking.tick(None);
            walking.plant.instability()
        });
        if let Some(unstable) = unstable {
            assert!(unstable.to_string().starts_with("the simulation became unstable at "), "{unstable}");
            let settings = walking.plant.unstable_settings();
            assert_eq!(settings[0], format!("unevenness.height_m = {height}"), "{settings:?}");
        } else {
            assert!(walking.plant.robot.is_finite() && height < 10.0, "{height}");
        }
    }
}

#[test]
fn a_walk_and_a_fall_are_no_instability() {
    let mut walking = Walking::begin(1);
    for tick in 0..4000 {
        if tick == 1000 {
            walking.plant.push([60.0, 60.0, 0.0].into(), 0.1);
        }
        walking.tick(None);
        assert_eq!(walking.plant.instability(), None, "in tick {tick}");
    }
    assert!(walking.plant.truth().has_fallen());
}
