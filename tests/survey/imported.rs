//! A public robot, imported from its URDF with nothing but its sole.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use config::Config;
use controller::Parameters;
use gait::{NominalTable, Start, Walk};
use halfstep_tests::walking::{PERIOD, Walking};
use interchange::import::NamedText;
use model::Mechanism;
use node::engine::EngineSetup;
use plant::{Disturbances, PlantParameters, RobotState};
use robots::ImportedRobot;

use crate::mujoco::Outside;

/// A robot that walks, with what it walks by.
pub(crate) struct Imported {
    /// What the importer found.
    pub robot: ImportedRobot,
    urdf: String,
    /// The robot.
    pub mechanism: Mechanism,
    /// Its nominal half-step.
    pub nominal: Arc<NominalTable>,
    /// As imported.
    pub controller: Parameters,
    /// As imported.
    pub plant: PlantParameters,
}

/// The folders of the robots, in order.
pub(crate) fn folders(robots: &Path) -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> = match std::fs::read_dir(robots) {
        Ok(entries) => entries.flatten().map(|entry| entry.path()).filter(|path| path.is_dir()).collect(),
        Err(error) => panic!("{}: {error}", robots.display()),
    };
    folders.sort();
    folders
}

impl Imported {
    /// Imports the robot of a folder with `robot.urdf` and `sole.toml`.
    pub(crate) fn import(folder: &Path) -> Self {
        let read = |name: &str| {
            let file = folder.join(name);
            std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
        };
        let (urdf, map) = (read("robot.urdf"), read("sole.toml"));
        let map = NamedText { text: &map, file: "sole.toml" };
        let imported = ImportedRobot::new(NamedText { text: &urdf, file: "robot.urdf" }, Some(map));
        let imported = imported.unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        let text = |name: &str| {
            let file = imported.files.iter().find(|(file, _)| *file == name);
            file.map_or("", |(_, text)| text.as_str())
        };
        let wrong = |error: &dyn std::fmt::Display| -> ! { panic!("{}: {error}", folder.display()) };
        Self {
            mechanism: Mechanism::from_toml(text("mechanism.toml"), "mechanism.toml").unwrap_or_else(|e| wrong(&e)),
            controller: Parameters::from_toml(text("controller.toml"), "controller.toml").unwrap_or_else(|e| wrong(&e)),
            plant: PlantParameters::from_toml(text("plant.toml"), "plant.toml").unwrap_or_else(|e| wrong(&e)),
            nominal: Arc::new(imported.half_step.synthesis.table.clone()),
            robot: imported,
            urdf,
        }
    }

    /// At the beginning of its nominal half-step.
    pub(crate) fn walking(&self, seed: u64) -> Walking {
        Walking::begin_by(&self.mechanism, Arc::clone(&self.nominal), &self.controller, &self.plant, seed)
    }

    /// The robot in MuJoCo, from its URDF.
    pub(crate) fn outside(&self, seed: u64) -> Outside {
        let (mechanism, plant) = (&self.mechanism, &self.plant);
        let walk = Walk::new(Arc::clone(&self.nominal), mechanism, &self.controller.gait, Start::default());
        let start = walk.unwrap_or_else(|error| panic!("{error}")).physical_motion();
        let begins = RobotState::on_right_foot(&start, 0.0);
        let setup = EngineSetup::new(mechanism, plant, &Disturbances::default(), &begins, seed, PERIOD);
        let setup = setup.unwrap_or_else(|error| panic!("{error}"));
        let source = mechanism.source.as_ref().unwrap_or_else(|| panic!("an imported robot has a source"));
        Outside::take_over(setup.with_urdf(self.urdf.clone(), source, mechanism, plant, seed))
    }
}
