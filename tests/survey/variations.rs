//! Variations: other floors, masses, loads, slopes and delays than the controller believes.

use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
#[cfg(feature = "mujoco")]
use interface::{Measurement, Setpoint};
#[cfg(feature = "mujoco")]
use model::Mechanism;
use nalgebra::{Vector2, Vector3};
#[cfg(feature = "mujoco")]
use plant::Disturbances;
use plant::{FloorRamp, FloorShape, FloorStep, FrictionTiles, Payload, Plant, PlantParameters, Slope};

use crate::asked;
use crate::cores::on_all_cores;
#[cfg(feature = "mujoco")]
use crate::mujoco::{Outside, start};
use crate::sensor_variations;
use crate::table::{self, millimetres};
use crate::watched::Watched;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How long each walk
    #[arg(long, default_value_t = 40.0)]
    seconds: f64,
    /// A harder world: nine walks on each of much worse floors, with worse sensors and loads
    #[arg(long)]
    hard: bool,
    /// Whose physics
    #[cfg(feature = "mujoco")]
    #[arg(long, value_enum, default_value_t = Physics::Rust)]
    plant: Physics,
    /// Only variations whose name contains this
    #[arg(long, default_value = "")]
    only: String,
    /// Robots whose masses are wrong, each in its own way
    #[arg(long, default_value_t = 4)]
    seeds: u64,
}

/// Who computes the physics.
#[cfg(feature = "mujoco")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Physics {
    /// Our plant
    Rust,
    /// MuJoCo
    Mujoco,
}

/// What moves the plant on by a control period.
#[cfg(feature = "mujoco")]
type PlantStep = Box<dyn FnMut(&mut Plant, &Setpoint) -> Measurement>;

/// Corners and edges of what must be walked, and its middle: `c` and `α` (deg).
const COMMANDS: [(f64, f64); 9] = [
    (0.7, -15.0),
    (0.7, 0.0),
    (0.7, 15.0),
    (1.0, -15.0),
    (1.0, 0.0),
    (1.0, 15.0),
    (1.3, -15.0),
    (1.3, 0.0),
    (1.3, 15.0),
];
/// The same in a harder world.
const COMMANDS_IN_HARD_WORLD: [(f64, f64); 9] = [
    (0.8, -15.0),
    (0.8, 0.0),
    (0.8, 15.0),
    (1.0, -15.0),
    (1.0, 0.0),
    (1.0, 15.0),
    (1.2, -15.0),
    (1.2, 0.0),
    (1.2, 15.0),
];
/// Where a step or a ramp begins (m).
const EDGE_FROM: f64 = 1.2;
/// When the walk leaves the nominal (s).
const ENTRY: f64 = 2.0;

/// What is other than believed, for people and for the plant.
struct Variation {
    name: String,
    parameters: PlantParameters,
    seed: u64,
}

pub(crate) fn survey(options: &Options) -> bool {
    let (mechanism, controller) = (mechanism(), controller_parameters());
    let (variations, commands) =
        if options.hard { (hard_variations(), COMMANDS_IN_HARD_WORLD) } else { (variations(options.seeds), COMMANDS) };
    let variations: Vec<_> =
        variations.into_iter().filter(|variation| variation.name.contains(&options.only)).collect();
    let walks = on_all_cores(variations.len() * commands.len(), |index| {
        let Variation { parameters, seed, .. } = &variations[index / commands.len()];
        let (speed, turn) = commands[index % commands.len()];
        // In a harder world each walk has its own noise and its own floor.
        let seed = if options.hard { (index % commands.len()) as u64 } else { *seed };
        #[cfg(feature = "mujoco")]
        let mut step = options.plant.begin(&mechanism, &controller, parameters, seed);
        #[cfg(not(feature = "mujoco"))]
        let mut step = Plant::step;
        let walking = Walking::begin_with(&mechanism, &controller, parameters, seed);
        let mut watched = Watched::begin_in(walking, &mut step);
        watched.walk_until(ENTRY, None, &mut step);
        watched.begin_anew();
        watched.walk_until(options.seconds, Some(asked::request(speed, turn, 0.0)), &mut step);
        watched
    });

    let rows: Vec<Vec<String>> = std::iter::zip(&variations, walks.chunks(commands.len()))
        .map(|(variation, walks)| {
            let falls = walks.iter().filter(|watched| watched.fall.is_some()).count();
            let least = walks.iter().map(|watched| watched.least_margin).fold(f64::INFINITY, f64::min);
            let largest = walks.iter().map(|watched| watched.largest_lean).fold(0.0, f64::max);
            vec![
                variation.name.clone(),
                format!("{falls} of {}", walks.len()),
                millimetres(least),
                format!("{:.2}", largest.to_degrees()),
            ]
        })
        .collect();
    table::print(&["variation", "falls", "least margin mm", "largest feedback °"], &rows);
    let mut passed = true;
    for (index, watched) in walks.iter().enumerate() {
        if let Some(fall) = &watched.fall {
            passed = false;
            println!("{}: {fall}", variations[index / commands.len()].name);
        }
    }
    passed
}

#[cfg(feature = "mujoco")]
impl Physics {
    /// Begins the walk of a robot.
    fn begin(
        self,
        mechanism: &Mechanism,
        controller: &controller::Parameters,
        parameters: &PlantParameters,
        seed: u64,
    ) -> PlantStep {
        match self {
            Self::Rust => Box::new(Plant::step),
            Self::Mujoco => {
                let (start, nothing) = (start(mechanism, controller), Disturbances::default());
                let mut outside = Outside::begin(mechanism, parameters, &nothing, &start, seed);
                Box::new(move |plant, setpoint| outside.step(plant, setpoint))
            }
        }
    }
}

fn vary(name: &str, change: impl Fn(&mut PlantParameters)) -> Variation {
    let mut parameters = plant_parameters();
    change(&mut parameters);
    Variation { name: name.to_owned(), parameters, seed: 0 }
}

fn slope(ahead: f64, left: f64) -> impl Fn(&mut PlantParameters) {
    let slope = Slope { ahead: ahead.to_radians(), left: left.to_radians() };
    move |parameters: &mut PlantParameters| parameters.slope = slope
}

/// A step across the walk, near enough to be met by walks that turn, too.
fn step(height: f64) -> impl Fn(&mut PlantParameters) {
    let step = FloorStep { direction: Vector2::x(), from: EDGE_FROM, height, length: f64::INFINITY };
    move |parameters: &mut PlantParameters| {
        parameters.floor = FloorShape { steps: vec![step], ..FloorShape::default() };
    }
}

/// A ramp without end, entered on foot.
///
/// * `rise` – its slope (deg)
/// * `heading` – of its direction upward against that of the walk, to the left (deg)
fn ramp(rise: f64, heading: f64) -> impl Fn(&mut PlantParameters) {
    let (sin, cos) = heading.to_radians().sin_cos();
    let ramp = FloorRamp { direction: Vector2::new(cos, sin), from: EDGE_FROM, rise: rise.to_radians(), length: 1e3 };
    move |parameters: &mut PlantParameters| {
        parameters.floor = FloorShape { ramps: vec![ramp], ..FloorShape::default() };
    }
}

fn tiles(height: f64) -> impl Fn(&mut PlantParameters) {
    move |parameters: &mut PlantParameters| parameters.unevenness.height = height
}

/// What a robot should walk on and with one day.
fn hard_variations() -> Vec<Variation> {
    let behind = Vector3::new(-0.15, 0.0, 0.28);
    let mut variations: Vec<Variation> =
        [2.0, 4.0, 6.0, 8.0, 10.0, 15.0].map(|height| vary(&format!("tiles {height} mm"), tiles(height * 1e-3))).into();
    for degrees in [4.0, 6.0, 8.0] {
        variations.extend([
            vary(&format!("slope {degrees}° up ahead"), slope(degrees, 0.0)),
            vary(&format!("slope {degrees}° down ahead"), slope(-degrees, 0.0)),
            vary(&format!("slope {degrees}° up to the left"), slope(0.0, degrees)),
            vary(&format!("slope {degrees}° up to the right"), slope(0.0, -degrees)),
            vary(&format!("ramp {degrees}° up ahead"), ramp(degrees, 0.0)),
            vary(&format!("ramp {degrees}° down ahead"), ramp(-degrees, 0.0)),
            vary(&format!("ramp {degrees}° up, 60° to the left"), ramp(degrees, 60.0)),
            vary(&format!("ramp {degrees}° up, 60° to the right"), ramp(degrees, -60.0)),
        ]);
    }
    variations.extend([
        vary("step 10 mm up", step(0.01)),
        vary("step 10 mm down", step(-0.01)),
        vary("step 30 mm up", step(0.03)),
        vary("step 30 mm down", step(-0.03)),
        vary("friction 0.4", |parameters| parameters.contact.friction = 0.4),
        vary("friction 0.3 to 0.8 by tile", |parameters| {
            let friction = FrictionTiles { least: 0.3, greatest: 0.8, tile: 0.3 };
            parameters.floor = FloorShape { friction_tiles: Some(friction), ..FloorShape::default() };
        }),
        vary("sensor delay 5 ms", |parameters| parameters.sensors.delay_periods = 5),
        vary("payload 10 kg behind", |parameters| parameters.payload = Payload { mass: 10.0, at: behind }),
        vary("masses ±10 %", |parameters| parameters.mass_error = 0.1),
    ]);
    variations.extend(sensor_variations::IN_HARD_WORLD.map(|(name, change)| vary(name, change)));
    variations
}

fn variations(seeds: u64) -> Vec<Variation> {
    let payload = |place: Vector3<f64>| {
        move |parameters: &mut PlantParameters| parameters.payload = Payload { mass: 5.0, at: place }
    };
    let mut variations = vec![
        vary("nothing", |_| {}),
        vary("friction 0.5", |parameters| parameters.contact.friction = 0.5),
        vary("payload 5 kg high", payload(Vector3::new(0.0, 0.0, 0.5))),
        vary("payload 5 kg behind", payload(Vector3::new(-0.15, 0.0, 0.28))),
        vary("payload 5 kg to the left", payload(Vector3::new(0.0, 0.15, 0.28))),
        vary("slope 2° up ahead", slope(2.0, 0.0)),
        vary("slope 2° down ahead", slope(-2.0, 0.0)),
        vary("slope 2° up to the left", slope(0.0, 2.0)),
        vary("slope 2° up to the right", slope(0.0, -2.0)),
        vary("tiles 2 mm", tiles(0.002)),
        vary("sensor delay 3 ms", |parameters| parameters.sensors.delay_periods = 3),
    ];
    variations.extend((0..seeds).map(|seed| Variation {
        name: format!("masses ±5 %, seed {seed}"),
        parameters: PlantParameters { mass_error: 0.05, ..plant_parameters() },
        seed,
    }));
    variations
}
