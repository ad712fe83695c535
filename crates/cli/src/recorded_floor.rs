//! The floor of a recorded run, made again from what is attached to its recording.

use std::fs;
use std::path::{Component, Path};

use config::Config;
use node::configuration::PLANT;
use plant::{Ground, PlantParameters};
use plots::picture::FloorHeights;
use record::Provenance;

use crate::error::CliError;

/// The floor of a ground for pictures.
pub(crate) fn floor_of(ground: Ground) -> FloorHeights {
    if ground.is_plane() { FloorHeights::PLANE } else { FloorHeights::new(move |place| ground.height(place)) }
}

/// The ground on which a recorded run walked; `None` if no parameters of a plant are attached, as for a robot that
/// Halfstep does not simulate.
///
/// # Errors
/// The parameters are not those of this version, or a file that they name is not attached.
pub(crate) fn recorded_ground(provenance: &Provenance) -> Result<Option<Ground>, CliError> {
    let Some(text) = provenance.file(PLANT) else { return Ok(None) };
    let seed = provenance.entry("plant", "seed").and_then(|seed| seed.parse().ok()).unwrap_or(0);
    // Parameters may name a file of heights beside theirs.
    let folder = tempfile::tempdir().map_err(CliError::file(&std::env::temp_dir()))?;
    for (name, text) in &provenance.files {
        if Path::new(name).components().all(|part| matches!(part, Component::Normal(_))) {
            let file = folder.path().join(name);
            let put = file.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&file, text));
            put.map_err(CliError::file(&file))?;
        }
    }
    let file = folder.path().join(PLANT);
    let parameters = PlantParameters::from_toml(text, &file.display().to_string());
    let parameters = parameters.map_err(|error| {
        // The folder is gone when this is read.
        CliError::bad_input(error.to_string().replace(&format!("{}/", folder.path().display()), ""))
    })?;
    Ok(Some(parameters.ground(seed)))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    fn recorded(files: &[(&str, &str)]) -> Provenance {
        let files = files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
        Provenance { metadata: Vec::new(), files }
    }

    #[test]
    fn the_floor_is_that_of_the_attached_files() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/plant.toml");
        let plain = fs::read_to_string(file).expect("a committed file");
        let field = "\n[floor.height_field]\nfile = \"hills/one.csv\"\norigin_m = [1, -1]\nspacing_m = 1\n";
        let shaped = plain.clone() + field;
        assert!(recorded_ground(&recorded(&[])).unwrap().is_none());
        assert!(recorded_ground(&recorded(&[(PLANT, &plain)])).unwrap().is_some_and(|ground| ground.is_plane()));
        let files = [(PLANT, shaped.as_str()), ("hills/one.csv", "0,0,0\n0,0.3,0\n0,0,0\n"), ("../outside.csv", "0")];
        let ground = recorded_ground(&recorded(&files)).unwrap().unwrap();
        assert!((ground.height(Vector2::new(2.0, 0.0)) - 0.3).abs() < 1e-12);
        let error = recorded_ground(&recorded(&files[..1])).unwrap_err().to_string();
        assert!(error.contains("hills/one.csv") && !error.contains("/tmp/"), "{error}");
    }
}
