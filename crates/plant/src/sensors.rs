//! The sensors: delay, resolution and noise between the true state and the measurement.

use config::Table;
use interface::Measurement;
use model::{JointVector, PerJoint, Wrench};
use nalgebra::{UnitQuaternion, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// How the sensors err. Standard deviations of white noise per sample; all zero for perfect sensors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorParameters {
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
    /// Noise of the motor currents (A).
    pub current_noise: f64,
}

/// All sensors. The same seed yields the same noise.
#[derive(Clone, Debug)]
pub struct Sensors {
    parameters: SensorParameters,
    noise: ChaCha8Rng,
    /// Samples on their way, oldest first.
    underway: heapless::Deque<Measurement, { Sensors::DELAY_MAX + 1 }>,
}

impl SensorParameters {
    /// Sensors without delay, rounding or noise.
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

    /// Reads the table `[sensors]`.
    pub(crate) fn read(table: &Table) -> Self {
        Self {
            delay_periods: table.integer("delay_periods", 0, Sensors::DELAY_MAX as u64) as u32,
            angle_resolution: table.angle("angle_resolution_deg").between(0.0, 10.0),
            rate_noise: table.angle("rate_noise_deg_per_s").between(0.0, 1000.0),
            force_noise: table.number("force_noise_n").between(0.0, 1e4),
            moment_noise: table.number("moment_noise_n_m").between(0.0, 1e3),
            orientation_noise: table.angle("orientation_noise_deg").between(0.0, 45.0),
            angular_rate_noise: table.angle("angular_rate_noise_deg_per_s").between(0.0, 1000.0),
            current_noise: table.number("current_noise_a").between(0.0, 1000.0),
        }
    }
}

impl Sensors {
    /// Longest delay (control periods).
    pub const DELAY_MAX: usize = 31;

    /// Sensors with these errors.
    pub fn new(parameters: SensorParameters, seed: u64) -> Self {
        Self { parameters, noise: ChaCha8Rng::seed_from_u64(seed), underway: heapless::Deque::new() }
    }

    /// Takes the true values of this control period, and returns the sample that arrives in it. Until the first sample
    /// has arrived, that sample is returned.
    pub fn sense(&mut self, truth: &Measurement) -> Measurement {
        let number = truth.sample;
        let sample = self.disturbed(truth);
        let delay = (self.parameters.delay_periods as usize).min(Self::DELAY_MAX);
        if self.underway.len() > delay {
            self.underway.pop_front();
        }
        // Never full: at most `delay` ≤ DELAY_MAX samples remain.
        let _ = self.underway.push_back(sample);
        Measurement { sample: number, ..self.underway.front().copied().unwrap_or(sample) }
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
            orientation: truth.orientation
                * UnitQuaternion::from_scaled_axis(self.vector(parameters.orientation_noise)).into_inner(),
            angular_rate: truth.angular_rate + self.vector(parameters.angular_rate_noise),
            currents: self.noisy_joints(&truth.currents, parameters.current_noise),
        }
    }

    fn noisy_joints(&mut self, truth: &JointVector, deviation: f64) -> JointVector {
        PerJoint::from_fn(|joint| if joint.is_powered() { truth[joint] + self.normal(deviation) } else { truth[joint] })
    }

    fn vector(&mut self, deviation: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.normal(deviation))
    }

    fn normal(&mut self, deviation: f64) -> f64 {
        if deviation == 0.0 {
            return 0.0;
        }
        let normal: f64 = StandardNormal.sample(&mut self.noise);
        deviation * normal
    }
}
