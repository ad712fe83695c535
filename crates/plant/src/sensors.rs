//! The sensors: rate, delay, resolution, bias and noise between the true state and the measurement.

use config::Table;
use interface::Measurement;
use model::{JointVector, PerJoint, Wrench};
use nalgebra::{UnitQuaternion, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::normal_noise::NormalNoise;

/// How the sensors err. Standard deviations of white noise per sample; all zero for perfect sensors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorParameters {
    /// Control periods from sample to sample, 1 to [`Sensors::EVERY_MAX`].
    pub every_periods: u32,
    /// Delay of the samples (control periods), 0 to [`Sensors::DELAY_MAX`].
    pub delay_periods: u32,
    /// Resolution of the joint encoders (rad); 0 for continuous angles.
    pub angle_resolution: f64,
    /// Noise of the joint rates (rad/s).
    pub rate_noise: f64,
    /// Noise of each component of the forces on the feet (N).
    pub force_noise: f64,
    /// Noise of each component of the moments on the feet (N·m).
    pub moment_noise: f64,
    /// Noise of the trunk's orientation about each of its axes (rad).
    pub orientation_noise: f64,
    /// Noise of the trunk's angular rate about each of its axes (rad/s).
    pub angular_rate_noise: f64,
    /// Noise of each component of the trunk's specific force (m/s²).
    pub specific_force_noise: f64,
    /// Noise of the motor currents (A).
    pub current_noise: f64,
    /// How the inertial measurement unit is turned in the trunk: roll, pitch, yaw (rad).
    pub mounting: Vector3<f64>,
    /// Bias of the gyro about the axes of the inertial measurement unit (rad/s).
    pub gyro_bias: Vector3<f64>,
}

/// Number of the random stream of the accelerometer's noise; the errors of mass have another one.
const ACCELEROMETER_STREAM: u64 = 2;

/// All sensors. The same seed yields the same noise.
#[derive(Clone, Debug)]
pub struct Sensors {
    parameters: SensorParameters,
    normal: NormalNoise,
    noise: ChaCha8Rng,
    /// Of the accelerometer: another stream, so that it leaves the noise of the others as it is.
    accelerometer_noise: ChaCha8Rng,
    /// From the axes of the inertial measurement unit to those of the trunk.
    mounting: UnitQuaternion<f64>,
    /// What arrives in the coming control periods, oldest first.
    underway: heapless::Deque<Measurement, { Sensors::DELAY_MAX + 1 }>,
}

impl SensorParameters {
    /// Sensors without delay, rounding or noise.
    pub const PERFECT: SensorParameters = SensorParameters {
        every_periods: 1,
        delay_periods: 0,
        angle_resolution: 0.0,
        rate_noise: 0.0,
        force_noise: 0.0,
        moment_noise: 0.0,
        orientation_noise: 0.0,
        angular_rate_noise: 0.0,
        specific_force_noise: 0.0,
        current_noise: 0.0,
        mounting: Vector3::new(0.0, 0.0, 0.0),
        gyro_bias: Vector3::new(0.0, 0.0, 0.0),
    };

    /// Reads the table `[sensors]`. Keys that older files do not have may be left out.
    pub(crate) fn read(table: &Table) -> Self {
        let every_periods = if table.has("every_periods") {
            table.integer("every_periods", 1, u64::from(Sensors::EVERY_MAX)) as u32
        } else {
            1
        };
        let vector = |key: &str, max: f64| {
            let must = format!("each must lie between -{max} and {max}");
            let in_range = |numbers: &[f64; 3]| numbers.iter().all(|number| number.abs() <= max);
            if table.has(key) { Vector3::from(table.numbers(key).that(in_range, &must)) } else { Vector3::zeros() }
        };
        let specific_force_noise = if table.has("specific_force_noise_m_per_s2") {
            table.number("specific_force_noise_m_per_s2").between(0.0, 1000.0)
        } else {
            0.0
        };
        Self {
            every_periods,
            delay_periods: table.integer("delay_periods", 0, Sensors::DELAY_MAX as u64) as u32,
            angle_resolution: table.angle("angle_resolution_deg").between(0.0, 10.0),
            rate_noise: table.angle("rate_noise_deg_per_s").between(0.0, 1000.0),
            force_noise: table.number("force_noise_n").between(0.0, 1e4),
            moment_noise: table.number("moment_noise_n_m").between(0.0, 1e3),
            orientation_noise: table.angle("orientation_noise_deg").between(0.0, 45.0),
            angular_rate_noise: table.angle("angular_rate_noise_deg_per_s").between(0.0, 1000.0),
            specific_force_noise,
            current_noise: table.number("current_noise_a").between(0.0, 1000.0),
            mounting: vector("imu_mounting_deg", 45.0).map(f64::to_radians),
            gyro_bias: vector("gyro_bias_deg_per_s", 100.0).map(f64::to_radians),
        }
    }
}

impl Sensors {
    /// Longest delay (control periods).
    pub const DELAY_MAX: usize = 31;

    /// Most control periods from sample to sample.
    pub const EVERY_MAX: u32 = 100;

    /// Sensors with these errors.
    pub fn new(parameters: SensorParameters, seed: u64) -> Self {
        let noise = ChaCha8Rng::seed_from_u64(seed);
        let mut accelerometer_noise = noise.clone();
        accelerometer_noise.set_stream(ACCELEROMETER_STREAM);
        let [roll, pitch, yaw] = parameters.mounting.into();
        let mounting = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        Self {
            parameters,
            normal: NormalNoise::new(),
            noise,
            accelerometer_noise,
            mounting,
            underway: heapless::Deque::new(),
        }
    }

    /// Takes the true values of this control period, and returns the sample that arrives in it: that of the period
    /// before, with its number, when no new one does. Until the first sample has arrived, that sample is returned.
    pub fn sense(&mut self, truth: &Measurement) -> Measurement {
        let number = truth.sample;
        let sample = match self.underway.back() {
            Some(last) if !number.is_multiple_of(self.parameters.every_periods.max(1).into()) => *last,
            _ => self.disturbed(truth),
        };
        let delay = (self.parameters.delay_periods as usize).min(Self::DELAY_MAX);
        if self.underway.len() > delay {
            self.underway.pop_front();
        }
        // Never full: at most `delay` ≤ DELAY_MAX samples remain.
        let _ = self.underway.push_back(sample);
        let arrives = self.underway.front().copied().unwrap_or(sample);
        // A sample is numbered by the period in which it arrives.
        let arrived_for = number.saturating_sub(arrives.sample).saturating_sub(delay as u64);
        Measurement { sample: number - arrived_for, ..arrives }
    }

    fn disturbed(&mut self, truth: &Measurement) -> Measurement {
        let parameters = self.parameters;
        let resolution = parameters.angle_resolution;
        let encoder = |angle: f64| if resolution > 0.0 { (angle / resolution).round() * resolution } else { angle };
        Measurement {
            sample: truth.sample,
            angles: PerJoint(truth.angles.0.map(encoder)),
            rates: self.noisy_joints(&truth.rates, parameters.rate_noise),
            feet: truth.feet.map(|foot| Wrench {
                force: foot.force + self.vector(parameters.force_noise),
                moment: foot.moment + self.vector(parameters.moment_noise),
            }),
            orientation: (truth.orientation * self.mounting.into_inner())
                * UnitQuaternion::from_scaled_axis(self.vector(parameters.orientation_noise)).into_inner(),
            angular_rate: self.mounting.inverse() * truth.angular_rate
                + parameters.gyro_bias
                + self.vector(parameters.angular_rate_noise),
            currents: self.noisy_joints(&truth.currents, parameters.current_noise),
            specific_force: self.mounting.inverse() * truth.specific_force
                + Vector3::from_fn(|_, _| {
                    deviated(&self.normal, &mut self.accelerometer_noise, parameters.specific_force_noise)
                }),
            missing: truth.missing,
        }
    }

    fn noisy_joints(&mut self, truth: &JointVector, deviation: f64) -> JointVector {
        PerJoint::from_fn(|joint| if joint.is_powered() { truth[joint] + self.normal(deviation) } else { truth[joint] })
    }

    fn vector(&mut self, deviation: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.normal(deviation))
    }

    fn normal(&mut self, deviation: f64) -> f64 {
        deviated(&self.normal, &mut self.noise, deviation)
    }
}

/// White noise of this standard deviation.
fn deviated(normal: &NormalNoise, random: &mut ChaCha8Rng, deviation: f64) -> f64 {
    if deviation == 0.0 { 0.0 } else { deviation * normal.draw(random) }
}
