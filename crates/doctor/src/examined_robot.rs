//! The robot that is examined, and how one of its proportions is usually set.

use std::sync::Arc;

use config::{Config, ConfigErrors};
use controller::Parameters;
use gait::{NominalTable, Robot};
use interchange::scaled_parameters::{controller_text, plant_text, servos};
use model::{GRAVITY, LegReach, Mechanism};
use plant::PlantParameters;

/// Everything that can be set about a robot and its simulation, but for its half-step.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotSetup {
    /// The robot with its drives.
    pub mechanism: Mechanism,
    /// `controller.toml`.
    pub controller: Parameters,
    /// `plant.toml`.
    pub plant: PlantParameters,
}

/// The robot that is examined.
#[derive(Clone, Debug)]
pub struct ExaminedRobot {
    /// How it is set up.
    pub setup: RobotSetup,
    /// How a robot of its size and mass is usually set up: the settings of the paper's robot in its proportions.
    pub usual: RobotSetup,
    /// Its half-step.
    pub nominal: Arc<NominalTable>,
    /// Control period (s).
    pub period: f64,
}

impl ExaminedRobot {
    /// A robot as configured.
    ///
    /// * `paper` – texts of the paper's robot's `controller.toml` and `plant.toml`
    ///
    /// # Errors
    /// These texts are wrong.
    pub fn new(
        robot: &Robot,
        controller: Parameters,
        plant: PlantParameters,
        period: f64,
        paper: [&str; 2],
    ) -> Result<Self, ConfigErrors> {
        let mechanism = robot.mechanism.clone();
        let usual = RobotSetup {
            controller: Parameters::from_toml(&controller_text(paper[0], &mechanism), "controller.toml")?,
            plant: PlantParameters::from_toml(&plant_text(paper[1], &mechanism), "plant.toml")?,
            mechanism: Mechanism {
                servos: servos(mechanism.mass(), LegReach::of(&mechanism).length()),
                ..mechanism.clone()
            },
        };
        let setup = RobotSetup { mechanism, controller, plant };
        Ok(Self { setup, usual, nominal: Arc::clone(&robot.nominal), period })
    }

    /// Length of the stretched leg (m).
    pub(crate) fn leg(&self) -> f64 {
        LegReach::of(&self.setup.mechanism).length()
    }

    /// The impulse that accelerates the robot to the speed `√(g·leg)` (N·s), by which pushes on robots of all sizes are
    /// compared.
    pub(crate) fn impulse_unit(&self) -> f64 {
        self.setup.mechanism.mass() * (GRAVITY * self.leg()).sqrt()
    }
}
