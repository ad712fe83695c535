//! Plausibility of single values: which a working sensor of this robot could produce.

use interface::{Fault, Measurement, Sensor, SensorGroup};
use model::{GRAVITY, Joint, JointLimits, Mechanism, PerJoint, Side};

use crate::rejected_sensors::RejectedSensors;
use crate::validator_parameters::ValidatorParameters;

/// Deviation of a measured quaternion's norm from 1 up to which it is an orientation.
const NORM_TOLERANCE: f64 = 0.01;
/// Largest component of the specific force at the trunk that an accelerometer tells (m/s²): about 100 g.
const SPECIFIC_FORCE_MAX: f64 = 1000.0;

/// What sensors of a robot can tell.
#[derive(Clone, Debug)]
pub(crate) struct Plausibility {
    parameters: ValidatorParameters,
    limits: PerJoint<Option<JointLimits>>,
    /// Largest plausible force on a foot (N).
    force_max: f64,
}

impl Plausibility {
    /// The sensors of a robot.
    pub(crate) fn new(mechanism: &Mechanism, parameters: &ValidatorParameters) -> Self {
        Self {
            parameters: *parameters,
            limits: PerJoint::from_fn(|joint| mechanism.links[joint].limits),
            force_max: parameters.load_factor_max * mechanism.mass() * GRAVITY,
        }
    }

    /// Rejects values that are missing, are not finite, or that no working sensor of this robot produces.
    pub(crate) fn check(&self, measurement: &Measurement, rejected: &mut RejectedSensors) {
        let ValidatorParameters { angle_tolerance, rate_factor_max, trunk_rate_max, .. } = self.parameters;
        let is_there = |group| !measurement.missing.contains(group);
        let judge = |is_finite: bool, is_plausible: bool| match (is_finite, is_plausible) {
            (false, _) => Some(Fault::MeasurementNotFinite),
            (_, false) => Some(Fault::MeasurementImplausible),
            _ => None,
        };
        for joint in Joint::ALL {
            let (angle, rate) = (measurement.angles[joint], measurement.rates[joint]);
            if !is_there(SensorGroup::Joints) {
                rejected.insert(Fault::MeasurementMissing, Sensor::JointAngle(joint));
                continue;
            }
            let is_in_range = |limits: &JointLimits| {
                (limits.angle_min - angle_tolerance..=limits.angle_max + angle_tolerance).contains(&angle)
            };
            let is_slow = |limits: &JointLimits| rate.abs() <= rate_factor_max * limits.rate_max;
            let limits = self.limits[joint].as_ref();
            if let Some(fault) = judge(angle.is_finite(), limits.is_none_or(is_in_range)) {
                rejected.insert(fault, Sensor::JointAngle(joint));
            } else if let Some(fault) = judge(rate.is_finite(), limits.is_none_or(is_slow)) {
                rejected.insert(fault, Sensor::JointRate(joint));
            }
        }
        let mut reject = |group, sensor, is_finite, is_plausible| {
            let missing = (!is_there(group)).then_some(Fault::MeasurementMissing);
            if let Some(fault) = missing.or(judge(is_finite, is_plausible)) {
                rejected.insert(fault, sensor);
            }
        };
        for side in Side::BOTH {
            let foot = &measurement.feet[side.index()];
            let is_plausible = foot.force.amax().max(foot.moment.amax()) <= self.force_max;
            reject(SensorGroup::of_foot(side), Sensor::Foot(side), foot.is_finite(), is_plausible);
        }
        let is_unit = (measurement.orientation.norm() - 1.0).abs() < NORM_TOLERANCE;
        reject(SensorGroup::Orientation, Sensor::Orientation, is_unit, true);
        let rate = &measurement.angular_rate;
        let is_finite = rate.iter().all(|rate| rate.is_finite());
        reject(SensorGroup::AngularRate, Sensor::AngularRate, is_finite, rate.amax() <= trunk_rate_max);
        let force = &measurement.specific_force;
        if is_there(SensorGroup::SpecificForce) {
            let is_finite = force.iter().all(|force| force.is_finite());
            reject(SensorGroup::SpecificForce, Sensor::Accelerometer, is_finite, force.amax() <= SPECIFIC_FORCE_MAX);
        } else {
            // A robot need not have one.
            rejected.do_without(SensorGroup::SpecificForce);
        }
    }
}
