//! The robots in the box: configuration folders that the program carries, so that it works from any folder.

/// A robot that the program carries.
#[derive(Clone, Copy, Debug)]
pub struct BuiltInRobot {
    /// Its name on the command line.
    pub name: &'static str,
    /// Names and texts of its configuration files.
    pub files: [(&'static str, &'static str); 5],
}

/// The five files of a folder, relative to this one.
macro_rules! robot {
    ($name:literal, $folder:literal) => {
        BuiltInRobot {
            name: $name,
            files: [
                ("mechanism.toml", include_str!(concat!("../../../", $folder, "/mechanism.toml"))),
                ("nominal_half_step.csv", include_str!(concat!("../../../", $folder, "/nominal_half_step.csv"))),
                ("controller.toml", include_str!(concat!("../../../", $folder, "/controller.toml"))),
                ("plant.toml", include_str!(concat!("../../../", $folder, "/plant.toml"))),
                ("realtime.toml", include_str!("../../../config/realtime.toml")),
            ],
        }
    };
}

/// All of them, the paper's first.
pub const ROBOTS: [BuiltInRobot; 10] = [
    robot!("paper", "config"),
    robot!("g1", "config/robots/g1"),
    robot!("gr1t1", "config/robots/gr1t1"),
    robot!("h1_2", "config/robots/h1_2"),
    robot!("jvrc1", "config/robots/jvrc1"),
    robot!("limx", "config/robots/limx"),
    robot!("op3", "config/robots/op3"),
    robot!("qinglong", "config/robots/qinglong"),
    robot!("t1", "config/robots/t1"),
    robot!("talos", "config/robots/talos"),
];

impl BuiltInRobot {
    /// The robot of this name.
    ///
    /// # Errors
    /// There is none; the error names all.
    pub fn named(name: &str) -> Result<Self, String> {
        ROBOTS.into_iter().find(|robot| robot.name == name).ok_or_else(|| {
            let names: Vec<&str> = ROBOTS.iter().map(|robot| robot.name).collect();
            format!("must be one of {}", names.join(", "))
        })
    }

    /// The robot of the paper.
    pub fn of_the_paper() -> Self {
        ROBOTS[0]
    }

    /// The text of its mechanism file.
    pub fn mechanism_text(&self) -> &'static str {
        self.files[0].1
    }

    /// The texts of its files for controller and plant.
    pub fn parameter_texts(&self) -> [&'static str; 2] {
        [self.files[2].1, self.files[3].1]
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use config::Config;
    use gait::{NominalTable, Walk};
    use model::Mechanism;

    use super::*;

    #[test]
    fn every_robot_in_the_box_is_complete_and_its_half_step_is_its_own() {
        for robot in ROBOTS {
            let text = |name: &str| robot.files.iter().find(|(file, _)| *file == name).map(|(_, text)| *text).unwrap();
            let mechanism = Mechanism::from_toml(text("mechanism.toml"), robot.name).unwrap();
            let nominal = NominalTable::from_csv(text("nominal_half_step.csv"), Path::new(robot.name)).unwrap();
            let controller = controller::Parameters::from_toml(text("controller.toml"), robot.name).unwrap();
            plant::PlantParameters::from_toml(text("plant.toml"), robot.name).unwrap();
            Walk::new(Arc::new(nominal), &mechanism, &controller.gait, gait::Start::default()).unwrap();
        }
    }

    #[test]
    fn a_name_that_is_none_is_answered_by_all_names() {
        assert!(BuiltInRobot::named("g2").unwrap_err().contains("g1, gr1t1"));
        assert_eq!(BuiltInRobot::named("g1").unwrap().name, "g1");
    }
}
