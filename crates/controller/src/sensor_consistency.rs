//! Consistency of the sensors with each other and with what was commanded: finds sensors whose values are plausible one
//! by one and yet wrong.
//!
//! * **Frozen**: a noisy sensor never repeats its value to the bit ([`FrozenValues`]).
//! * **Trunk**: the vertical that the gyro predicts must stay close to the measured one ([`TrunkConsistency`]).
//! * **Joints**: an angle must stay close to its setpoint, and to the integral of its rate ([`JointConsistency`]).
//! * **Feet**: over a while they carry the weight, and in a half-step the support foot does ([`LoadConsistency`]).
//!
//! A sensor that contradicts is rejected at once: for a while the robot goes on without it, which costs less than
//! feedback of a wrong value. Only if that lasts does the robot stop.

mod expectation;
mod frozen_values;
mod joint_consistency;
mod load_consistency;
mod parameters;
mod trunk_consistency;

use interface::{Measurement, Rejection};
use nalgebra::Vector3;

pub(crate) use expectation::{Expectation, ExpectedSupport};
pub use parameters::ConsistencyParameters;

use crate::rejected_sensors::RejectedSensors;

use frozen_values::FrozenValues;
use joint_consistency::JointConsistency;
use load_consistency::LoadConsistency;
use trunk_consistency::TrunkConsistency;

/// Checks measurements against each other and against setpoints.
#[derive(Clone, Debug)]
pub(crate) struct SensorConsistency {
    parameters: ConsistencyParameters,
    /// The robot's weight (N).
    weight: f64,
    last: Option<Measurement>,
    frozen: FrozenValues,
    trunk: TrunkConsistency,
    joints: JointConsistency,
    loads: LoadConsistency,
}

impl SensorConsistency {
    /// A check that has seen no measurement, of a robot of this weight (N).
    pub(crate) fn new(parameters: ConsistencyParameters, weight: f64) -> Self {
        Self {
            parameters,
            weight,
            last: None,
            frozen: FrozenValues::default(),
            trunk: TrunkConsistency::default(),
            joints: JointConsistency::default(),
            loads: LoadConsistency::default(),
        }
    }

    /// Checks a new sample, and rejects what contradicts.
    ///
    /// * `vertical` – measured, in trunk axes (unit vector)
    /// * `dt` – time since the sample before (s)
    pub(crate) fn update(
        &mut self,
        measurement: &Measurement,
        vertical: &Vector3<f64>,
        expected: &Expectation,
        dt: f64,
        rejected: &mut RejectedSensors,
    ) {
        let last = self.last.replace(*measurement).unwrap_or(*measurement);
        self.frozen.update(measurement, &last, &expected.setpoint.rates, self.weight, dt, rejected);
        let trunk = self.trunk.update(measurement, &last, vertical, self.parameters.orientation_error_max, dt);
        trunk.into_iter().for_each(|Rejection { fault, sensor }| rejected.insert(fault, sensor));
        self.joints.update(measurement, &last, expected, &self.parameters, dt, rejected);
        let shares = measurement.feet.map(|foot| foot.force.z / self.weight);
        let loads = self.loads.update(shares, expected.support, self.parameters.load_share, dt);
        loads.into_iter().for_each(|Rejection { fault, sensor }| rejected.insert(fault, sensor));
    }

    /// Forgets the past: the robot was set up anew, or nothing was measured for long.
    pub(crate) fn reset(&mut self) {
        *self = Self::new(self.parameters, self.weight);
    }
}
