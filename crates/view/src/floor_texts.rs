//! The texts from which the floor of a run is made anew, beside a plant that runs or in a recording of it.

use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use config::Config;
use plant::PlantParameters;
use record::Provenance;
use scene::FloorCells;
use serde::{Deserialize, Serialize};

/// What decides about the floor.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FloorTexts {
    /// Text of `plant.toml`.
    pub plant: String,
    /// Names and texts of files beside it, among them that of the heights, if it names one.
    pub files: Vec<(String, String)>,
    /// Seed of the tiles.
    pub seed: u64,
}

/// The file in the folder of an instance. It is removed when this is dropped.
#[derive(Debug)]
pub struct FloorFile(PathBuf);

/// Its name.
const FILE: &str = "floor.json";

impl FloorTexts {
    /// Leaves the texts in the folder of an instance, for those who look on.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn leave_in(&self, folder: &Path) -> io::Result<FloorFile> {
        let file = folder.join(FILE);
        fs::write(&file, serde_json::to_string(self)?)?;
        Ok(FloorFile(file))
    }

    /// What the plant has left in the folder of an instance; `None` if it is a plane, or its plant tells nothing.
    pub(crate) fn left_in(folder: &Path) -> Option<Self> {
        serde_json::from_str(&fs::read_to_string(folder.join(FILE)).ok()?).ok()
    }

    /// Those of a recording; `None` if it lacks that of the plant.
    pub(crate) fn of_recording(origin: &Provenance) -> Option<Self> {
        let plant = origin.file("plant.toml")?.to_owned();
        let seed = origin.entry("plant", "seed")?.parse().ok()?;
        Some(Self { plant, files: origin.files.clone(), seed })
    }

    /// The floor; `None` if it is a plane, or its file cannot be read any more.
    pub(crate) fn cells(&self) -> Option<FloorCells> {
        // The file of heights is found beside the one that names it.
        let folder = tempfile::tempdir().ok()?;
        for (name, text) in &self.files {
            // Nothing is written outside the folder, whatever a recording says.
            let is_beside = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
            if is_beside && !name.is_empty() {
                let file = folder.path().join(name);
                fs::create_dir_all(file.parent()?).ok()?;
                fs::write(file, text).ok()?;
            }
        }
        let file = folder.path().join("plant.toml");
        let parameters = PlantParameters::from_toml(&self.plant, &file.display().to_string()).ok()?;
        FloorCells::new(parameters.ground(self.seed))
    }
}

impl Drop for FloorFile {
    fn drop(&mut self) {
        // Where it stays, it is replaced by the next plant.
        let _ = fs::remove_file(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLANT: &str = include_str!("../../../config/plant.toml");

    fn texts(more: &str, files: &[(&str, &str)]) -> FloorTexts {
        let files = files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned()));
        FloorTexts { plant: format!("{PLANT}\n{more}"), files: files.collect(), seed: 3 }
    }

    #[test]
    fn a_floor_is_told_through_the_folder_of_an_instance() {
        let folder = tempfile::tempdir().unwrap();
        let told = texts("[[floor.step]]\nfrom_m = 1\nheight_m = 0.03\n", &[]);
        let left = told.leave_in(folder.path()).unwrap();
        assert_eq!(FloorTexts::left_in(folder.path()), Some(told.clone()));
        assert!(told.cells().is_some());
        drop(left);
        assert_eq!(FloorTexts::left_in(folder.path()), None);
        assert!(texts("", &[]).cells().is_none(), "a plane");
    }

    #[test]
    fn heights_of_a_file_come_along() {
        let table = "[floor.height_field]\nfile = \"floors/heights.csv\"\norigin_m = [1, -1]\nspacing_m = 1\n";
        let told = texts(table, &[("floors/heights.csv", "0,0,0\n0,0.02,0\n0,0,0\n"), ("../elsewhere", "")]);
        let cells = told.cells().expect("heights");
        let pieces = cells.pieces([[1, -1]]);
        let highest = pieces.iter().flat_map(|piece| &piece.corners).map(|corner| corner[2]).fold(0.0, f64::max);
        assert!((highest - 0.02).abs() < 1e-9, "{pieces:?}");
    }
}
