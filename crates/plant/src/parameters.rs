//! What can be set about the simulated robot beyond its mechanism.

use std::path::Path;

use model::config::{self, ConfigErrors, Document, Table};
use model::{Joint, PerJoint};

use crate::{Payload, Slope, Unevenness};

/// Steepest floor [deg]: far beyond what anyone stands on.
const SLOPE_MAX_DEG: f64 = 40.0;

/// All of it; `config/plant.toml`.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Integration steps per control period.
    pub steps_per_period: u32,
    /// Largest share by which each link's mass and inertia are wrong, 0 to 1; the plant's seed decides.
    pub mass_error: f64,
    /// How the floor rises.
    pub slope: Slope,
    /// How uneven it is.
    pub unevenness: Unevenness,
    /// What the robot carries.
    pub payload: Payload,
    /// The ground under the soles.
    pub contact: ContactParameters,
    /// The drives' position servos.
    pub servo: PerJoint<ServoParameters>,
    /// The sensors' imperfections.
    pub sensors: SensorParameters,
}

impl Parameters {
    /// Reads a plant file.
    ///
    /// # Errors
    /// When the file cannot be read, and every key that is unknown, missing or out of range.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ConfigErrors> {
        let path = path.as_ref();
        Self::from_toml(&config::read(path)?, &path.display().to_string())
    }

    /// Reads the text of a plant file; `file` is its name for messages.
    ///
    /// # Errors
    /// Every key that is unknown, missing or out of range.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ConfigErrors> {
        let document = Document::parse(text, file)?;
        let root = document.root();
        let servos = root.table("servo");
        let (legs_and_waist, arms) = (servo(&servos.table("legs_and_waist")), servo(&servos.table("arms")));
        let parameters = Self {
            steps_per_period: root.integer("steps_per_period", 1, 100) as u32,
            mass_error: root.number("mass_error").between(0.0, 0.5),
            slope: slope(&root.table("slope")),
            unevenness: unevenness(&root.table("unevenness")),
            payload: payload(&root.table("payload")),
            contact: contact(&root.table("contact")),
            servo: PerJoint::from_fn(|joint| if joint >= Joint::RightShoulder { arms } else { legs_and_waist }),
            sensors: sensors(&root.table("sensors")),
        };
        document.finish(parameters)
    }
}

fn slope(table: &Table) -> Slope {
    Slope {
        ahead: table.angle("ahead_deg").between(-SLOPE_MAX_DEG, SLOPE_MAX_DEG),
        left: table.angle("left_deg").between(-SLOPE_MAX_DEG, SLOPE_MAX_DEG),
    }
}

fn unevenness(table: &Table) -> Unevenness {
    Unevenness { height: table.number("height_m").not_negative(), tile: table.number("tile_m").positive() }
}

fn payload(table: &Table) -> Payload {
    Payload { mass: table.number("mass_kg").not_negative(), at: table.numbers("at_m").any().into() }
}

fn contact(table: &Table) -> ContactParameters {
    ContactParameters {
        stiffness: table.number("stiffness_n_per_m").positive(),
        damping: table.number("damping_n_s_per_m").not_negative(),
        stiffness_tangential: table.number("stiffness_tangential_n_per_m").positive(),
        damping_tangential: table.number("damping_tangential_n_s_per_m").not_negative(),
        friction: table.number("friction").not_negative(),
    }
}

fn servo(table: &Table) -> ServoParameters {
    ServoParameters {
        stiffness: table.number("stiffness_n_m_per_rad").not_negative(),
        damping: table.number("damping_n_m_s_per_rad").not_negative(),
    }
}

fn sensors(table: &Table) -> SensorParameters {
    SensorParameters {
        delay_periods: table.integer("delay_periods", 0, crate::Sensors::DELAY_MAX as u64) as u32,
        angle_resolution: table.angle("angle_resolution_deg").not_negative(),
        rate_noise: table.angle("rate_noise_deg_per_s").not_negative(),
        force_noise: table.number("force_noise_n").not_negative(),
        moment_noise: table.number("moment_noise_n_m").not_negative(),
        orientation_noise: table.angle("orientation_noise_deg").not_negative(),
        angular_rate_noise: table.angle("angular_rate_noise_deg_per_s").not_negative(),
        current_noise: table.number("current_noise_a").not_negative(),
    }
}

/// Ground and sole, per corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactParameters {
    /// Normal stiffness [N/m]. Tipping stiffness follows: four corners 4 cm off the middle must be far stiffer than the
    /// robot's own fall (m·g·h ≈ 700 N·m/rad).
    pub stiffness: f64,
    /// Normal damping [N·s/m].
    pub damping: f64,
    /// Stiffness of the friction bristle [N/m].
    pub stiffness_tangential: f64,
    /// Damping of the friction bristle [N·s/m].
    pub damping_tangential: f64,
    /// Friction coefficient `μ`.
    pub friction: f64,
}

/// A drive's position servo, seen at the joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoParameters {
    /// [N·m/rad]
    pub stiffness: f64,
    /// [N·m·s/rad]
    pub damping: f64,
}

/// How the sensors err. Standard deviations of white noise per sample; all zero for perfect sensors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorParameters {
    /// Samples arrive this many control periods late, 0 to [`crate::Sensors::DELAY_MAX`].
    pub delay_periods: u32,
    /// Smallest difference of a joint angle that the encoder tells [rad]; 0 for none.
    pub angle_resolution: f64,
    /// [rad/s]
    pub rate_noise: f64,
    /// [N]
    pub force_noise: f64,
    /// [N·m]
    pub moment_noise: f64,
    /// [rad]
    pub orientation_noise: f64,
    /// [rad/s]
    pub angular_rate_noise: f64,
    /// [A]
    pub current_noise: f64,
}

impl Default for ContactParameters {
    fn default() -> Self {
        Self { stiffness: 1.0e6, damping: 2.0e3, stiffness_tangential: 5.0e5, damping_tangential: 1.0e3, friction: 0.8 }
    }
}

impl SensorParameters {
    /// Sensors that tell the truth at once.
    pub const PERFECT: SensorParameters = SensorParameters {
        delay_periods: 0,
        angle_resolution: 0.0,
        rate_noise: 0.0,
        force_noise: 0.0,
        moment_noise: 0.0,
        orientation_noise: 0.0,
        angular_rate_noise: 0.0,
        current_noise: 0.0,
    };
}

impl Default for SensorParameters {
    fn default() -> Self {
        Self {
            delay_periods: 1,
            angle_resolution: 0.001_f64.to_radians(),
            rate_noise: 0.3_f64.to_radians(),
            force_noise: 2.0,
            moment_noise: 0.2,
            orientation_noise: 0.05_f64.to_radians(),
            angular_rate_noise: 0.3_f64.to_radians(),
            current_noise: 0.05,
        }
    }
}

impl Default for Parameters {
    fn default() -> Self {
        let legs_and_waist = ServoParameters { stiffness: 5000.0, damping: 150.0 };
        let arms = ServoParameters { stiffness: 500.0, damping: 15.0 };
        Self {
            steps_per_period: 2,
            mass_error: 0.0,
            slope: Slope::default(),
            unevenness: Unevenness::default(),
            payload: Payload::default(),
            contact: ContactParameters::default(),
            servo: PerJoint::from_fn(|joint| if joint >= Joint::RightShoulder { arms } else { legs_and_waist }),
            sensors: SensorParameters::default(),
        }
    }
}
