//! The paper's figures on the committed robot.

use config::Config;
use std::path::PathBuf;

use gait::Robot;
use node::configuration::{ConfigFiles, Errors};
use paper::{Figure, Reading, Scenario, reproduce};

use crate::repository;

/// `config/`.
pub fn config() -> PathBuf {
    repository().join("config")
}

/// The committed robot with its nominal.
pub fn robot() -> Robot {
    let mut errors = Errors::default();
    let robot = ConfigFiles::new(config(), None, None).robot(&mut errors);
    errors.finish(robot).expect("the committed robot loads")
}

/// `config/paper.toml`.
pub fn reading() -> Reading {
    Reading::load(config().join("paper.toml")).expect("the committed reading loads")
}

/// All of `config/scenarios`.
pub fn scenarios() -> Vec<Scenario> {
    Scenario::load_all(&config().join("scenarios")).expect("the committed scenarios load")
}

/// The scenario of a figure.
pub fn scenario(figure: u64) -> Scenario {
    scenarios().into_iter().find(|scenario| scenario.figure == figure).expect("the figure has a scenario")
}

/// All figures, reproduced.
pub fn figures(robot: &Robot, reading: Reading) -> Vec<Figure> {
    let figure = |scenario| reproduce(robot, reading, scenario).expect("the robot turns and extends its steps");
    scenarios().iter().map(figure).collect()
}

/// The numbers of the figures whose stated verdict is another one here.
pub fn misses(figures: &[Figure]) -> Vec<u64> {
    figures.iter().filter(|figure| figure.agrees() == Some(false)).map(|figure| figure.scenario.figure).collect()
}
