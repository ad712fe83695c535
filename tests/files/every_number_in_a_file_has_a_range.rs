//! Goal: no number of any file is taken that makes no sense. Each number of the committed files is replaced by absurd
//! ones: it is refused, or what is loaded walks on finite numbers. A new key cannot be forgotten: the files are
//! searched for numbers, not for keys.

use std::ops::Range;
use std::sync::Arc;

use controller::Controller;
use gait::{Start, Walk};
use halfstep_tests::walking::{Walking, controller_parameters, nominal, plant_parameters};
use interface::Setpoint;
use plant::PlantParameters;

use super::loaders::{Loaded, files};

/// What nobody means.
const ABSURD: [&str; 7] = ["1e300", "-1e300", "1e-300", "nan", "inf", "0", "\"x\""];
/// Ticks of a walk of 0.2 s.
const TICKS: u32 = 200;

/// The places of all numbers that are values, in a file of keys and values, and of some in tables and URDFs.
fn numbers(name: &str, text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut begin = 0;
    for (number, line) in text.split_inclusive('\n').enumerate() {
        let code = line.split('#').next().unwrap_or_default();
        let values = match name {
            // Three rows of 61 have all columns.
            "nominal_half_step.csv" => [6, 36, 65].contains(&number).then_some(0),
            _ if name.ends_with(".csv") || name.ends_with(".urdf") || name.ends_with(".jsonl") => Some(0),
            _ => code.find('=').map(|at| at + 1),
        };
        if let Some(values) = values {
            let is_quoted =
                |word: &Range<usize>| name.ends_with(".toml") && code[..word.start].matches('"').count() % 2 > 0;
            let of_line =
                words(code, values).filter(|word| !is_quoted(word)).map(|word| begin + word.start..begin + word.end);
            found.extend(of_line);
        }
        begin += line.len();
    }
    found
}

/// The places of the numbers in a line, from a byte on.
fn words(line: &str, from: usize) -> impl Iterator<Item = Range<usize>> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '+' | '_');
    let mut at = from;
    let mut words = Vec::new();
    while at < line.len() {
        let rest = &line[at..];
        let length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        if length > 0 && rest[..length].parse::<f64>().is_ok_and(f64::is_finite) {
            words.push(at..at + length);
        }
        at += length.max(rest.chars().next().map_or(1, char::len_utf8));
    }
    words.into_iter()
}

/// Walks with what was loaded; words if it cannot begin.
fn walk(loaded: &Loaded) -> Result<(), String> {
    let mut mechanism = halfstep_tests::mechanism();
    let (mut controller, mut plant, mut table) = (controller_parameters(), plant_parameters(), (*nominal()).clone());
    let mut disturbances = None;
    match loaded {
        Loaded::Mechanism(changed) => mechanism = (**changed).clone(),
        Loaded::Controller(changed) => controller = **changed,
        Loaded::Plant(changed) => plant = (**changed).clone(),
        Loaded::Nominal(changed) => table = changed.clone(),
        Loaded::Disturbances(changed) => disturbances = Some(changed.clone()),
        Loaded::Other => return Ok(()),
    }
    // As if the half-step had been made for the mechanism.
    table.mechanism = mechanism.body_fingerprint;
    let table = Arc::new(table);
    Walk::new(table.clone(), &mechanism, &controller.gait, Start::default()).map_err(|error| error.to_string())?;
    Controller::new(&mechanism, table.clone(), &controller, Start::default()).map_err(|error| error.to_string())?;
    let mut walking = Walking::begin_by(&mechanism, table, &controller, &plant, 1);
    walking.plant.disturbances = disturbances.unwrap_or_default();
    for tick in 0..TICKS {
        let Setpoint { angles, rates, feed_forward } = walking.tick(None).setpoint;
        assert!([angles, rates, feed_forward].iter().all(|values| values.is_finite()), "setpoint in tick {tick}");
        if let Some(unstable) = walking.plant.instability() {
            return Err(unstable.to_string());
        }
        assert!(walking.plant.robot.is_finite(), "the robot in tick {tick}");
    }
    Ok(())
}

#[test]
fn absurd_numbers_are_refused_or_walk_on_finite_numbers() {
    for file in files() {
        let (mut refused, mut walked) = (0, 0);
        let places = numbers(file.name, &file.text);
        assert!(!places.is_empty() || file.name == "paper.toml", "{} has no numbers", file.name);
        for place in places {
            for absurd in ABSURD {
                let mut text = file.text.clone();
                text.replace_range(place.clone(), absurd);
                let what =
                    || format!("{}: {} → {absurd} at byte {}", file.name, &file.text[place.clone()], place.start);
                match file.load(&text) {
                    Err(words) => {
                        assert!(words.contains('f') && words.len() > 10, "{}: {words}", what());
                        refused += 1;
                    }
                    Ok(loaded) => {
                        if let Err(unstable) = walk(&loaded) {
                            assert!(!unstable.contains("unstable"), "{} is taken: {unstable}", what());
                        }
                        walked += 1;
                    }
                }
                if ["1e300", "-1e300", "nan", "inf"].contains(&absurd) && !file.name.ends_with(".jsonl") {
                    let is_refused = file.load(&text).is_err();
                    assert!(is_refused || is_unused(file.name, &file.text, &place), "{} is taken", what());
                }
            }
        }
        println!("{}: {refused} refused, {walked} walked", file.name);
    }
}

/// Whether a number has no meaning for us: of a URDF what is only drawn, efforts, and what MuJoCo reads.
fn is_unused(name: &str, text: &str, place: &Range<usize>) -> bool {
    let before = &text[..place.start];
    let is_within = |element: &str| {
        let open = before.rfind(&format!("<{element}"));
        open.is_some_and(|open| !before[open..].contains(&format!("</{element}>")))
    };
    let attribute = before.rsplit(' ').next().unwrap_or_default();
    name == "robot.urdf"
        && (["effort", "version", "encoding", "name"].iter().any(|unused| attribute.starts_with(unused))
            || ["visual", "collision", "mujoco", "dynamics", "safety_controller"].into_iter().any(is_within))
}

/// The ends of the ranges are taken, and never end in a panic or a setpoint that is not finite.
#[test]
fn the_ends_of_every_range_walk() {
    for file in files().into_iter().filter(|file| file.name.ends_with(".toml")) {
        for place in numbers(file.name, &file.text) {
            let mut text = file.text.clone();
            text.replace_range(place.clone(), "1e300");
            let Err(words) = file.load(&text) else { continue };
            let Some((_, range)) = words.lines().next().and_then(|line| line.split_once(" between ")) else { continue };
            let mut ends = range.split([' ', ',']).filter_map(|word| word.parse::<f64>().ok());
            for end in ends.by_ref().take(2) {
                let mut text = file.text.clone();
                text.replace_range(place.clone(), &end.to_string());
                if let Ok(loaded) = file.load(&text) {
                    // That it may become unstable is told, with the settings to look at.
                    let _ = walk(&loaded);
                }
            }
        }
    }
}

/// What was once taken, with the words that refuse it.
#[test]
fn mistakes_of_unit_are_refused_with_the_range() {
    let load = |name: &str, from: &str, to: &str| {
        let file = files().into_iter().find(|file| file.name == name).expect("a file");
        assert!(file.text.contains(from), "{name}: {from}");
        file.load(&file.text.replacen(from, to, 1)).err().unwrap_or_else(|| panic!("{name}: {to} is taken"))
    };
    for (name, from, to, words) in [
        ("plant.toml", "height_m = 0", "height_m = 2", "f:23:12: unevenness.height_m = 2: must lie between 0 and 0.1"),
        ("plant.toml", "tile_m = 0.3", "tile_m = 300000", "must lie between 0.01 and 100"),
        ("plant.toml", "mass_kg = 0", "mass_kg = 1e9", "payload.mass_kg = 1e9: must lie between 0 and 1000"),
        ("controller.toml", "silence_max_s = 0.1", "silence_max_s = 1e300", "must lie between 0.005 and 1"),
        ("controller.toml", "edge_m = 0.005", "edge_m = 1e9", "feedback.edge_m = 1e9: must lie between 0 and 0.1"),
        ("mechanism.toml", "mass_kg = 28.625", "mass_kg = 1e9", "joint.waist_roll.mass_kg = 1e9: must lie between"),
        ("mechanism.toml", "width_m = 0.08", "width_m = 1e-9", "sole.width_m = 1e-9: must lie between 0.001 and 2"),
        ("mechanism.toml", "rotor_inertia_kg_m2 = 5.6e-5", "rotor_inertia_kg_m2 = 0.9", "must be smaller: times gear"),
        ("nominal_half_step.csv", "\n0,0.0,0.0,", "\n0,0.0,1e308,", "f:6: joint_01_angle_rad is `1e308`; it must be"),
    ] {
        let refused = load(name, from, to);
        assert!(refused.contains(words), "{name}: {refused}");
    }
}

#[test]
fn an_uneven_floor_is_lower_than_its_tiles_are_long() {
    let text = files().into_iter().find(|file| file.name == "plant.toml").expect("a file").text;
    let text = text.replace("height_m = 0", "height_m = 0.05").replace("tile_m = 0.3", "tile_m = 0.02");
    let refused = <PlantParameters as config::Config>::from_toml(&text, "f").unwrap_err().to_string();
    assert!(refused.contains("unevenness.height_m = 0.05: must be at most tile_m, which is 0.02"), "{refused}");
}
