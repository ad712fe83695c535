//! The parameters of the simulated robot beyond its mechanism.

use config::{Config, Table};

use crate::{ContactParameters, FloorShape, Ground, Payload, SensorParameters, ServoShares, Slope, Unevenness};

/// The parameters of the simulated robot; `config/plant.toml`.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantParameters {
    /// Integration steps per control period.
    pub steps_per_period: u32,
    /// Largest share by which each link's mass and inertia are wrong, 0 to 0.5 (-); the plant's seed decides.
    pub mass_error: f64,
    /// Slope of the floor.
    pub slope: Slope,
    /// Unevenness of the floor.
    pub unevenness: Unevenness,
    /// Shape and friction of the floor beyond that.
    pub floor: FloorShape,
    /// The mass that the robot carries.
    pub payload: Payload,
    /// Contact of soles and ground.
    pub contact: ContactParameters,
    /// What the drives' servos have of the mechanism's.
    pub servo: ServoShares,
    /// Delay, resolution and noise of the sensors.
    pub sensors: SensorParameters,
}

impl PlantParameters {
    /// The ground of a run with a seed.
    pub fn ground(&self, seed: u64) -> Ground {
        Ground::new(self.unevenness, self.floor.clone(), self.contact.friction, seed)
    }
}

impl Config for PlantParameters {
    fn read(root: &Table) -> Self {
        Self {
            steps_per_period: root.integer("steps_per_period", 1, 100) as u32,
            mass_error: root.number("mass_error").between(0.0, 0.5),
            slope: Slope::read(&root.table("slope")),
            unevenness: Unevenness::read(&root.table("unevenness")),
            floor: FloorShape::read(root),
            payload: Payload::read(&root.table("payload")),
            contact: ContactParameters::read(&root.table("contact")),
            servo: ServoShares::read(root),
            sensors: SensorParameters::read(&root.table("sensors")),
        }
    }
}
