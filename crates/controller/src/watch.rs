//! Watches the measurements: what is stale, out of order, no number or absurd does not get through.

use model::{GRAVITY, JointLimits, Mechanism, PerJoint};
use nalgebra::Vector3;

use crate::{Fault, Faults, Measurement, WatchParameters};

/// How far beyond its range a joint may be told to be [rad]: stops give way, encoders are mounted by hand.
const ANGLE_SLACK: f64 = 0.5;
/// How many times faster than its limit a joint may be told to move.
const RATE_SLACK: f64 = 5.0;
/// Largest rate of the trunk [rad/s].
const TRUNK_RATE_MAX: f64 = 50.0;
/// Largest force on a foot, in weights of the robot; moments likewise, at an arm of a metre.
const WEIGHTS_MAX: f64 = 50.0;

/// Remembers how long ago a measurement was good.
#[derive(Clone, Debug)]
pub struct Watch {
    parameters: WatchParameters,
    limits: PerJoint<Option<JointLimits>>,
    force_max: f64,
    newest: Option<u64>,
    silence: f64,
}

impl Watch {
    /// Nothing seen yet; the allowed silence begins now.
    pub fn new(mechanism: &Mechanism, parameters: WatchParameters) -> Self {
        Self {
            parameters,
            limits: PerJoint::from_fn(|joint| mechanism.links[joint].limits),
            force_max: WEIGHTS_MAX * mechanism.mass() * GRAVITY,
            newest: None,
            silence: 0.0,
        }
    }

    /// Absorbs what came within the last `dt` seconds and lets a good measurement through, with the vertical in its
    /// trunk's axes.
    pub fn update<'m>(
        &mut self,
        measurement: Option<&'m Measurement>,
        dt: f64,
        faults: &mut Faults,
    ) -> Option<(&'m Measurement, Vector3<f64>)> {
        self.silence += dt;
        let good = measurement.and_then(|measurement| match measurement.up_in_trunk() {
            // After a long silence a plant that counts from the start again is a new one.
            _ if !self.is_stale() && self.newest.is_some_and(|newest| measurement.tick < newest) => {
                faults.insert(Fault::MeasurementOutOfOrder);
                None
            }
            // The same sample again is no news, but no fault either: the two processes' periods drift.
            _ if self.newest == Some(measurement.tick) => None,
            Some(_) if self.is_absurd(measurement) => {
                faults.insert(Fault::MeasurementAbsurd);
                None
            }
            Some(up) => Some((measurement, up)),
            None => {
                faults.insert(Fault::MeasurementNotFinite);
                None
            }
        });
        if let Some((measurement, _)) = good {
            self.newest = Some(measurement.tick);
            self.silence = 0.0;
        }
        if self.is_stale() {
            faults.insert(Fault::MeasurementStale);
        }
        good
    }

    /// Whether some value is one that no working sensor of this robot gives.
    fn is_absurd(&self, measurement: &Measurement) -> bool {
        let joints = self.limits.iter().filter_map(|(joint, limits)| limits.map(|limits| (joint, limits)));
        let joints_absurd = joints.into_iter().any(|(joint, limits)| {
            measurement.angles[joint] < limits.angle_min - ANGLE_SLACK
                || measurement.angles[joint] > limits.angle_max + ANGLE_SLACK
                || measurement.rates[joint].abs() > RATE_SLACK * limits.rate_max
        });
        let feet_absurd =
            measurement.feet.iter().any(|foot| foot.force.amax().max(foot.moment.amax()) > self.force_max);
        joints_absurd || feet_absurd || measurement.angular_rate.amax() > TRUNK_RATE_MAX
    }

    /// Whether nothing good came for longer than allowed.
    pub fn is_stale(&self) -> bool {
        self.silence > self.parameters.silence_max
    }

    /// Whether the trunk tilts beyond recovery.
    pub fn has_fallen(&self, up_in_trunk: &Vector3<f64>) -> bool {
        up_in_trunk.z < self.parameters.tilt_max.cos()
    }
}
