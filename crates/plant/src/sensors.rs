//! The sensors: what of the truth reaches the controller, how late and how noisy.

use model::{JointVector, PerJoint, Wrench};
use nalgebra::{UnitQuaternion, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::SensorParameters;

/// What the robot senses in one control period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Which sample it is: the control period since the plant's start in which it should arrive. The same number again
    /// is the same sample again.
    pub sample: u64,
    /// Joint angles [rad]; the first two are the tilt of the bearing sole.
    pub angles: JointVector,
    /// [rad/s]; the first two are not sensed and zero.
    pub rates: JointVector,
    /// Of the ground on the right and on the left foot, about the sole's origin in sole axes.
    pub feet: [Wrench; 2],
    /// Of the trunk: maps trunk coordinates to level axes, whose z is the true vertical; world axes on a level floor.
    pub orientation: UnitQuaternion<f64>,
    /// Of the trunk, in its own axes [rad/s].
    pub angular_rate: Vector3<f64>,
    /// [A]
    pub currents: JointVector,
}

/// All sensors, with a seed: the same seed makes the same errors.
#[derive(Clone, Debug)]
pub struct Sensors {
    parameters: SensorParameters,
    noise: ChaCha8Rng,
    /// Samples on their way, oldest first.
    underway: heapless::Deque<Measurement, { Sensors::DELAY_MAX + 1 }>,
}

impl Sensors {
    /// Longest delay [control periods].
    pub const DELAY_MAX: usize = 31;

    /// Sensors with these imperfections.
    pub fn new(parameters: SensorParameters, seed: u64) -> Self {
        Self { parameters, noise: ChaCha8Rng::seed_from_u64(seed), underway: heapless::Deque::new() }
    }

    /// Absorbs the truth of this period and gives what arrives in it. Before the first sample has made its way, that
    /// first sample is what there is.
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
                * UnitQuaternion::from_scaled_axis(self.vector(parameters.orientation_noise)),
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
