//! Sensors that are slower, later or mounted otherwise than the controller believes, alone and with a robot that is
//! none of its model.

use nalgebra::Vector3;
use plant::{Payload, PlantParameters};

/// Makes sensors or robot other than believed.
pub(crate) type Change = fn(&mut PlantParameters);

/// Where a rucksack hangs, in the trunk's frame (m).
const BEHIND: Vector3<f64> = Vector3::new(-0.15, 0.0, 0.28);
/// Roll of the inertial measurement unit in the trunk (°).
const ASKEW: f64 = 1.0;

/// What a robot should walk with: each sensor's defect by itself, and all of them on a robot that carries a load and
/// whose masses are wrong.
pub(crate) const IN_HARD_WORLD: [(&str, Change); 4] = [
    ("sensors at half the rate", half_rate),
    ("IMU askew by 1° roll", askew),
    ("gyro bias 1°/s", |parameters| parameters.sensors.gyro_bias = Vector3::repeat(1_f64.to_radians())),
    ("half rate, 5 ms late, IMU askew, 10 kg behind, masses ±10 %", |parameters| {
        half_rate(parameters);
        askew(parameters);
        parameters.payload = Payload { mass: 10.0, at: BEHIND };
        parameters.sensors.delay_periods = 5;
        parameters.mass_error = 0.1;
    }),
];

fn half_rate(parameters: &mut PlantParameters) {
    parameters.sensors.every_periods = 2;
}

fn askew(parameters: &mut PlantParameters) {
    parameters.sensors.mounting.x = ASKEW.to_radians();
}
