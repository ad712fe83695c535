//! MuJoCo has the floors of `plant.toml` as our plant has them: the same height and friction at every place, and the
//! robot stands and walks on them there, too.
//!
//! Needs Python: `cargo test --workspace --tests -- --ignored`.

use std::io::Write;
use std::process::Stdio;

use halfstep_tests::walking::{PERIOD, Walking, controller_parameters, plant_parameters};
use halfstep_tests::{mechanism, python, random, repository};
use interface::Setpoint;
use model::Motion;
use nalgebra::{DMatrix, Vector2, Vector3};
use node::engine::{self, EngineSetup, ExternalEngine};
use plant::{
    Disturbances, FloorRamp, FloorShape, FloorStep, FrictionTiles, HeightField, Plant, PlantParameters, RobotState,
    Unevenness,
};
use rand::Rng;
use serde_json::{Value, json};

const PLACES: usize = 300;

/// Steps, a ramp, tiles, hills and tiles of friction, all at once.
fn everything() -> PlantParameters {
    let across = Vector2::new(30_f64.to_radians().cos(), 30_f64.to_radians().sin());
    let mut random = random(2);
    let heights = DMatrix::from_fn(7, 9, |_, _| random.random_range(-0.04..0.04));
    let floor = FloorShape {
        steps: vec![
            FloorStep { direction: Vector2::x(), from: 2.0, height: 0.03, length: 0.4 },
            FloorStep { direction: across, from: 2.7, height: -0.02, length: f64::INFINITY },
        ],
        ramps: vec![FloorRamp { direction: across, from: 1.9, rise: 0.15, length: 1.5 }],
        height_field: Some(HeightField::new(heights, Vector2::new(2.05, -0.6), 0.15)),
        friction_tiles: Some(FrictionTiles { least: 0.3, greatest: 0.8, tile: 0.5 }),
        friction_patches: Vec::new(),
    };
    PlantParameters { unevenness: Unevenness { height: 0.015, tile: 0.3 }, floor, ..plant_parameters() }
}

/// The robot over a place, with its right sole at a height (m).
fn over(place: Vector2<f64>, height: f64) -> RobotState {
    let mut robot = RobotState::on_right_foot(&Motion::default(), 0.0);
    robot.sole_to_world.translation.vector = place.push(height);
    robot
}

fn setup(parameters: &PlantParameters, robot: &RobotState, seed: u64) -> EngineSetup {
    EngineSetup::new(&mechanism(), parameters, &Disturbances::default(), robot, seed, PERIOD).expect("a floor")
}

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn floors_in_mujoco_have_the_same_height_and_friction_everywhere() {
    let program = "import json, sys, mujoco, numpy
sys.path.insert(0, sys.argv[1])
import plant
told = json.load(sys.stdin)
robot = plant.Robot(told['setup'])
found = []
for x, y in told['places']:
    geom = numpy.full(1, -1, dtype=numpy.int32)
    down = mujoco.mj_ray(robot.model, robot.data, [x, y, 2.0], [0, 0, -1], None, 1, -1, geom)
    found.append([2.0 - down, robot.model.geom_friction[geom[0], 0]] if geom[0] >= 0 else [float('nan')] * 2)
print(json.dumps(found))";
    let (parameters, seed, middle) = (everything(), 4, Vector2::new(2.4, 0.1));
    let ground = parameters.ground(seed);
    let mut random = random(8);
    let places: Vec<Vector2<f64>> = (0..PLACES)
        .map(|_| middle + Vector2::new(random.random_range(-1.1..1.1), random.random_range(-1.1..1.1)))
        .collect();
    let told = json!({
        // The robot hangs high above, so that rays see the floor only.
        "setup": setup(&parameters, &over(middle, 10.0), seed),
        "places": places.iter().map(|place| [place.x, place.y]).collect::<Vec<_>>(),
    });
    let folder = repository().join("tools/mujoco_plant");
    let mut python = python();
    let mut child =
        python.args(["-c", program]).arg(folder).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("Python");
    child.stdin.take().expect("a pipe").write_all(told.to_string().as_bytes()).expect("somebody who reads");
    let output = child.wait_with_output().expect("a child");
    assert!(output.status.success());
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let heights: Vec<f64> = places.iter().map(|place| ground.height(*place)).collect();
    let spread = heights.iter().fold(0.0, |spread: f64, height| spread.max((height - heights[0]).abs()));
    assert!(spread > 0.05, "the floor has shape: {spread} m");
    for ((place, height), found) in places.iter().zip(heights).zip(found.as_array().expect("a list")) {
        let [theirs, friction] = [0, 1].map(|index| found[index].as_f64().expect("a number"));
        assert!((theirs - height).abs() < 1e-6, "{theirs} m in MuJoCo, {height} m in our plant at {place}");
        assert_eq!(friction, ground.friction(*place), "at {place}");
    }
}

/// Stands for a second on a floor: how high each sole is over the floor in the end (m).
fn stands(parameters: &PlantParameters, place: Vector2<f64>, seed: u64, in_mujoco: bool) -> [f64; 2] {
    let ground = parameters.ground(seed);
    let robot = over(place, ground.height(place));
    let mut plant = Plant::new(&mechanism(), parameters, &Motion::default(), PERIOD, seed);
    plant.robot = robot.clone();
    let python = || engine::mujoco().unwrap_or_else(|failure| panic!("{failure}"));
    let mut engine = in_mujoco.then(|| {
        ExternalEngine::start(python(), &setup(parameters, &robot, seed)).unwrap_or_else(|error| panic!("{error}"))
    });
    for _ in 0..1000 {
        match &mut engine {
            Some(engine) => drop(engine.step(&mut plant, &Setpoint::default()).expect("a state")),
            None => drop(plant.step(&Setpoint::default())),
        }
    }
    let truth = plant.truth();
    assert!(!truth.has_fallen());
    truth.soles.map(|sole| {
        let at: Vector3<f64> = sole.translation.vector;
        at.z - ground.height(at.xy())
    })
}

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn soles_rest_on_the_same_tile_equally_high_in_mujoco() {
    let tiles = PlantParameters { unevenness: Unevenness { height: 0.02, tile: 1.0 }, ..plant_parameters() };
    for place in [Vector2::new(5.5, 0.4), Vector2::new(-3.5, 2.4)] {
        let is_off = |seed: &u64| tiles.ground(*seed).height(place).abs() > 0.01;
        let seed = (0..).find(is_off).expect("half of all tiles are");
        for in_mujoco in [false, true] {
            let over = stands(&tiles, place, seed, in_mujoco);
            assert!(over.iter().all(|over| over.abs() < 3e-4), "{over:?} m over the tile, in MuJoCo: {in_mujoco}");
        }
    }
}

/// Far enough that the floor is laid out anew several times.
#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn the_robot_walks_on_tiles_in_mujoco() {
    let tiles = PlantParameters { unevenness: Unevenness { height: 0.002, tile: 0.3 }, ..plant_parameters() };
    let (mechanism, controller) = (mechanism(), controller_parameters());
    let mut walking = Walking::begin_with(&mechanism, &controller, &tiles, 1);
    let python = engine::mujoco().unwrap_or_else(|failure| panic!("{failure}"));
    let begins = walking.plant.robot.clone();
    let mut engine =
        ExternalEngine::start(python, &setup(&tiles, &begins, 1)).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..12_000 {
        walking.tick_in(None, |plant, setpoint| engine.step(plant, setpoint).expect("a state"));
        assert!(!walking.plant.truth().has_fallen(), "fell at {:.2} s", walking.time());
    }
    assert!(walking.plant.truth().com.x > 3.0, "it has come to {}", walking.plant.truth().com);
}
