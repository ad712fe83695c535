//! The robot walks on ramps, low steps, hills and tiles of changing friction, of which it knows nothing.
//!
//! The survey `variations --hard` has floors that are harder, and says which of them are walked.

use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::Mode;
use nalgebra::{DMatrix, Vector2};
use plant::{FloorRamp, FloorShape, FloorStep, FrictionTiles, HeightField, PlantParameters};

/// Walks straight ahead over a floor; it must come this far (m).
const FAR: f64 = 4.0;

fn assert_walks(what: &str, floor: FloorShape) {
    for seed in 0..2 {
        let parameters = PlantParameters { floor: floor.clone(), ..plant_parameters() };
        let mut walking = Walking::begin_with(&mechanism(), &controller_parameters(), &parameters, seed);
        let truth = walking.walk(12.0);
        let mode = walking.tick(None).report.mode;
        assert!(!truth.has_fallen() && mode == Mode::Walking, "{what}, seed {seed}: fell by {:.1} s", walking.time());
        assert!(truth.com.x > FAR, "{what}: {} m", truth.com.x);
    }
}

#[test]
fn walks_up_a_ramp_and_down_again() {
    let ramp = |from: f64, rise: f64| FloorRamp { direction: Vector2::x(), from, rise: rise.to_radians(), length: 1.2 };
    assert_walks("a ramp", FloorShape { ramps: vec![ramp(0.8, 2.0), ramp(2.6, -2.0)], ..FloorShape::default() });
}

#[test]
fn walks_over_a_low_step_up_and_down() {
    for height in [0.004, -0.004] {
        let step = FloorStep { direction: Vector2::x(), from: 1.2, height, length: 1.7 };
        assert_walks("a step", FloorShape { steps: vec![step], ..FloorShape::default() });
    }
}

/// Waves of 3 mm, 1.2 m long, along and across.
#[test]
fn walks_over_hills() {
    let wave = |number: usize| (number as f64 * std::f64::consts::PI / 6.0).sin();
    let heights = DMatrix::from_fn(30, 60, |row, column| 0.003 * wave(row) * wave(column));
    let field = HeightField::new(heights, Vector2::new(0.8, -1.4), 0.1);
    assert_walks("hills", FloorShape { height_field: Some(field), ..FloorShape::default() });
}

#[test]
fn walks_on_tiles_of_changing_friction() {
    let friction_tiles = Some(FrictionTiles { least: 0.5, greatest: 0.8, tile: 0.3 });
    assert_walks("friction", FloorShape { friction_tiles, ..FloorShape::default() });
}
