//! Goal: what `[floor]` says is what the ground is, in the built-in plant and as pieces for other engines.
//!
//! Method: read texts of `plant.toml` with floors, look at heights, normals and friction at places, and compare every
//! piece with the ground under it.

use std::fs;

use config::Config;
use halfstep_tests::{random, repository};
use nalgebra::{Vector2, Vector3};
use plant::{Ground, GroundPiece, PlantParameters};
use rand::Rng;

/// The ground by the committed file with some lines more.
fn ground(lines: &str, seed: u64) -> Result<Ground, String> {
    let text = fs::read_to_string(repository().join("config/plant.toml")).expect("a committed file");
    let read = PlantParameters::from_toml(&(text + lines), "plant.toml").map_err(|errors| errors.to_string())?;
    Ok(read.ground(seed))
}

const STAIRS_AND_RAMP: &str = "
[[floor.step]]
from_m = 1
height_m = 0.03
[[floor.step]]
from_m = 1.3
height_m = 0.02
length_m = 0.5
[[floor.ramp]]
from_m = 2
rise_deg = 45e-1
length_m = 3
heading_deg = 90
[[floor.friction_patch]]
at_m = [0, -2]
size_m = [1, 0.5]
friction = 0.1
";

#[test]
fn steps_and_ramps_add_their_heights_where_they_are() {
    let ground = ground(STAIRS_AND_RAMP, 0).expect("a floor");
    let grade = 4.5_f64.to_radians().tan();
    for (x, y, height) in [
        (0.99, 0.0, 0.0),
        (1.01, 0.0, 0.03),
        (1.31, -9.0, 0.05),
        (1.81, 0.0, 0.03),
        (0.0, 3.0, grade),
        (1.5, 4.0, 0.05 + 2.0 * grade),
        (-7.0, 50.0, 3.0 * grade),
    ] {
        let found = ground.height(Vector2::new(x, y));
        assert!((found - height).abs() < 1e-12, "{found} m at {x}, {y}");
    }
    let normal = ground.normal(Vector2::new(1.5, 4.0));
    assert!((normal.angle(&Vector3::z()) - 4.5_f64.to_radians()).abs() < 1e-9 && normal.y < 0.0, "{normal}");
    assert_eq!(ground.normal(Vector2::new(1.5, 0.0)), Vector3::z());
    assert_eq!(ground.friction(Vector2::new(0.4, -1.8)), 0.1);
    assert_eq!(ground.friction(Vector2::new(0.6, -1.8)), 0.8);
}

#[test]
fn friction_of_tiles_fills_its_range_and_depends_on_the_seed() {
    let lines = "\n[floor.friction_tiles]\nleast = 0.3\ngreatest = 0.8\n";
    let [one, other] = [1, 2].map(|seed| ground(lines, seed).expect("a floor"));
    let places =
        (0..2000).map(|index| Vector2::new(0.75 + 0.3 * f64::from(index % 50), 0.15 + 0.3 * f64::from(index / 50)));
    let friction: Vec<f64> = places.clone().map(|place| one.friction(place)).collect();
    let mean = friction.iter().sum::<f64>() / 2000.0;
    assert!(friction.iter().all(|friction| (0.3..=0.8).contains(friction)) && (mean - 0.55).abs() < 0.01, "{mean}");
    assert!(places.zip(&friction).any(|(place, friction)| other.friction(place) != *friction));
    assert_eq!(one.friction(Vector2::new(0.2, 0.2)), 0.8, "where the walk begins");
}

/// Height over a piece at a place in it; `None` outside.
fn over(piece: &GroundPiece, place: Vector2<f64>) -> Option<f64> {
    let corners = &piece.corners;
    let is_inside = (0..corners.len()).all(|index| {
        let [from, to] = [corners[index].xy(), corners[(index + 1) % corners.len()].xy()];
        (to - from).perp(&(place - from)) > 1e-9
    });
    let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let offset = place - corners[0].xy();
    is_inside.then(|| corners[0].z - (normal.x * offset.x + normal.y * offset.y) / normal.z)
}

#[test]
fn pieces_are_the_ground() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = fs::read_to_string(repository().join("config/plant.toml")).expect("a committed file");
    let text = text.replace("height_m = 0\n", "height_m = 0.01\n");
    let field = "[floor.height_field]\nfile = \"hills.csv\"\nspacing_m = 0.2\norigin_m = [-1, -2.5]\n\
                 [floor.friction_tiles]\nleast = 0.3\ngreatest = 0.8\ntile_m = 0.45\n";
    let mut random = random(3);
    let mut line = || (0..8).map(|_| random.random_range(-0.05..0.05).to_string()).collect::<Vec<_>>().join(",");
    let lines = (0..7).map(|_| line()).collect::<Vec<_>>().join("\n");
    fs::write(folder.path().join("hills.csv"), lines).expect("it can be written");
    let file = folder.path().join("plant.toml");
    fs::write(&file, text + STAIRS_AND_RAMP + field).expect("it can be written");
    let parameters = PlantParameters::load(&file).unwrap_or_else(|errors| panic!("{errors}"));
    let ground = parameters.ground(5);
    assert_eq!(ground.finest_edge(), Some(0.2));

    for centre in [Vector2::new(1.0, 2.0), Vector2::new(-0.2, -1.6), Vector2::new(40.0, -7.0)] {
        let pieces = ground.pieces(centre, 1.2);
        let mut hits = 0;
        for _ in 0..4000 {
            let place = centre + Vector2::new(random.random_range(-1.2..1.2), random.random_range(-1.2..1.2));
            let found: Vec<(f64, f64)> =
                pieces.iter().filter_map(|piece| Some((over(piece, place)?, piece.friction))).collect();
            assert!(found.len() <= 1, "pieces overlap at {place}");
            for (height, friction) in found {
                hits += 1;
                assert!((height - ground.height(place)).abs() < 1e-9, "{height} at {place}");
                assert_eq!(friction, ground.friction(place), "at {place}");
            }
        }
        assert!(hits > 3980, "{hits} of 4000 places are covered");
    }
}

#[test]
fn examples_of_the_documentation_are_floors() {
    let page = fs::read_to_string(repository().join("docs/floors.md")).expect("a committed file");
    let examples: Vec<&str> = page.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(examples.len(), 5);
    for example in examples.into_iter().filter(|example| !example.contains("file =")) {
        let ground = ground(&format!("\n{example}"), 0).unwrap_or_else(|errors| panic!("{errors}\n{example}"));
        assert!(!ground.is_plane(), "{example}");
    }
}

#[test]
fn mistakes_in_floors_are_told_with_their_place() {
    for (lines, words) in [
        (
            "[[floor.step]]\nfrom_m = 0.1\nheight_m = 0.03\n",
            "floor.step[0].from_m = 0.1: must lie between 0.5 and 4000",
        ),
        ("[[floor.step]]\nfrom_m = 1\nheight_mm = 30\n", "floor.step[0].height_mm = 30: unknown key; write `height_m`"),
        ("[[floor.ramp]]\nfrom_m = 1\nrise_deg = 80\nlength_m = 1\n", "must lie between -40 and 40"),
        (
            "[floor.friction_tiles]\nleast = 0.8\ngreatest = 0.3\n",
            "greatest = 0.3: must be at least `least`, which is 0.8",
        ),
        (
            "[floor.height_field]\nfile = \"no.csv\"\nspacing_m = 0.1\norigin_m = [0, 0]\n",
            "file = \"no.csv\": must be readable: no.csv: cannot be read",
        ),
        ("[floor]\nsteps = 3\n", "floor.steps = 3: unknown key"),
    ] {
        let refused = ground(&format!("\n{lines}"), 0).map(|_| ()).unwrap_err();
        assert!(refused.starts_with("plant.toml:") && refused.contains(words), "{lines}{refused}");
    }
}

#[test]
fn a_height_field_that_is_not_level_at_the_start_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("hills.csv"), "0,0\n0,0.02\n").expect("it can be written");
    let file = folder.path().join("plant.toml");
    let text = fs::read_to_string(repository().join("config/plant.toml")).expect("a committed file");
    let lines = "\n[floor.height_field]\nfile = \"hills.csv\"\nspacing_m = 0.2\norigin_m = [0.2, 0.3]\n";
    fs::write(&file, text + lines).expect("it can be written");
    let refused = PlantParameters::load(&file).unwrap_err().to_string();
    assert!(refused.contains("has 0.02 m at x 0.400, y 0.500 m (row 2, column 2)"), "{refused}");
}
