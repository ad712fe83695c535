//! Faults planted in the configuration of a robot that walks, with the keys that the doctor must name.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use config::Config;
use controller::{Compensation, Parameters};
use doctor::{ExaminedRobot, Finding, RobotSetup, examine};
use gait::{NominalTable, Robot};
use model::{Joint, Mechanism};
use plant::PlantParameters;

use crate::repository;
use crate::walking::PERIOD;

/// A mistake in a configuration.
pub struct PlantedFault {
    /// What is wrong, in words.
    pub name: &'static str,
    /// Makes the mistake.
    pub plant: fn(&mut RobotSetup),
    /// The key that must be named first.
    pub key: &'static str,
}

const fn fault(name: &'static str, plant: fn(&mut RobotSetup), key: &'static str) -> PlantedFault {
    PlantedFault { name, plant, key }
}

/// All of them.
pub const PLANTED: [PlantedFault; 24] = [
    fault(
        "a thigh's inertia in kg·cm²",
        |it| it.mechanism.links[Joint::RightKnee].body.inertia *= 1e4,
        "joint.right_knee.inertia_kg_m2",
    ),
    fault("a trunk in grams", |it| it.mechanism.links[Joint::WaistRoll].body.mass *= 1e3, "joint.waist_roll.mass_kg"),
    fault(
        "soles 3 cm wide",
        |it| (it.mechanism.sole.inside, it.mechanism.sole.outside) = (0.015, 0.015),
        "sole.width_m",
    ),
    fault(
        "drives a fifth as stiff",
        |it| it.mechanism.servos.legs_and_waist.stiffness *= 0.2,
        "servo.legs_and_waist.stiffness_n_m_per_rad",
    ),
    fault(
        "drives damped eight times as much",
        |it| it.mechanism.servos.legs_and_waist.damping *= 8.0,
        "servo.legs_and_waist.damping_n_m_s_per_rad",
    ),
    fault("sensors 16 ms late", |it| it.plant.sensors.delay_periods = 16, "sensors.delay_periods"),
    fault(
        "orientation with 1° of noise",
        |it| it.plant.sensors.orientation_noise = 0.0175,
        "sensors.orientation_noise_deg",
    ),
    fault("forces with 60 N of noise", |it| it.plant.sensors.force_noise = 60.0, "sensors.force_noise_n"),
    fault("an inertial unit askew by 3°", |it| it.plant.sensors.mounting.y = 0.0524, "sensors.imu_mounting_deg"),
    fault("real drives a quarter as stiff", |it| it.plant.servo.stiffness = 0.25, "servo.stiffness_share"),
    fault("no feedback", |it| it.controller.stabilizer.feedback.gain = 0.0, "feedback.gain"),
    fault("a feedback gain of 15", |it| it.controller.stabilizer.feedback.gain = 15.0, "feedback.gain"),
    fault("35 mm kept from the edge", |it| it.controller.stabilizer.feedback.edge = 0.035, "feedback.edge_m"),
    fault(
        "ankles that answer after 0.4 s",
        |it| it.controller.stabilizer.feedback.support_ankle_time_constant = 0.4,
        "feedback.lag_s",
    ),
    fault(
        "a foot damped within 1 ms",
        |it| it.controller.stabilizer.feedback.foot_damping_time_constant = 1e-3,
        "feedback.zmp_lag_s",
    ),
    fault(
        "legs that give way when they land",
        |it| it.controller.stabilizer.landing.damping = 10.0,
        "landing.damping_n_s_per_m",
    ),
    fault("a foot bears from 500 N on", |it| it.controller.stabilizer.zmp.force_min = 500.0, "zmp.force_min_n"),
    fault(
        "speed changed within 0.05 s",
        |it| it.controller.gait.speed_ramp = Duration::from_millis(50),
        "gait.speed_ramp_s",
    ),
    fault("a ZMP margin of 4 cm asked for", |it| it.controller.feasibility.margin_min = 0.04, "forecast.margin_min_m"),
    fault("no planned centre of mass", |it| it.controller.compensation = Compensation::None, "gait.compensation"),
    fault("a load of 45 kg", |it| it.plant.payload.mass = 45.0, "payload.mass_kg"),
    fault("a floor of ice", |it| it.plant.contact.friction = 0.08, "contact.friction"),
    fault("a floor of foam", |it| it.plant.contact.stiffness = 1.5e4, "contact.stiffness_n_per_m"),
    fault("a slope of 8°", |it| it.plant.slope.ahead = 0.14, "slope.ahead_deg"),
];

/// The robot of a configuration folder of the repository.
pub fn examined(folder: impl AsRef<Path>) -> ExaminedRobot {
    let file = |name: &str| repository().join(folder.as_ref()).join(name);
    let paper = |name: &str| std::fs::read_to_string(repository().join("config").join(name)).expect("it is committed");
    let robot = Robot {
        mechanism: Mechanism::load(file("mechanism.toml")).expect("it loads"),
        nominal: Arc::new(NominalTable::read_csv(&file("nominal_half_step.csv")).expect("it loads")),
    };
    let controller = Parameters::load(file("controller.toml")).expect("it loads");
    let plant = PlantParameters::load(file("plant.toml")).expect("it loads");
    let paper = [paper("controller.toml"), paper("plant.toml")];
    ExaminedRobot::new(&robot, controller, plant, PERIOD, [&paper[0], &paper[1]]).expect("they load")
}

/// The first thing that is wrong with a robot.
pub fn first_wrong(examined: &ExaminedRobot) -> Option<Finding> {
    let mut last = None;
    let timing = Finding::good("timing", String::new());
    let is_healthy = examine(examined, &timing, |finding| last = Some(finding.clone()));
    last.filter(|_| !is_healthy)
}

impl PlantedFault {
    /// The first thing that is wrong with the paper's robot with this mistake.
    pub fn found(&self) -> Option<Finding> {
        let mut examined = examined("config");
        (self.plant)(&mut examined.setup);
        first_wrong(&examined)
    }

    /// Whether a finding names its key first.
    pub fn is_named_by(&self, finding: Option<&Finding>) -> bool {
        finding.and_then(|finding| finding.remedies.first()).is_some_and(|remedy| remedy.key == self.key)
    }
}
