//! A measurement, expressed in support coordinates.

use dynamics::Kinematics;
use interface::{Measurement, SensorGroup, SensorGroups};
use model::{Joint, JointVector, Mechanism, Mirror, Mirrored, Side, Wrench};
use nalgebra::Vector3;

/// A measurement as seen from the support foot; with the left foot supporting, everything is mirrored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportFrameMeasurement {
    /// Joint angles (rad); joints 3 to 8 are those of the support leg.
    pub angles: JointVector,
    /// Joint rates (rad/s).
    pub rates: JointVector,
    /// Wrench of the ground on the support foot, about the origin of its sole in sole axes.
    pub support_foot: Wrench,
    /// Wrench of the ground on the swing foot, about the origin of its sole in sole axes.
    pub swing_foot: Wrench,
    /// The vertical, a unit vector in the axes of the trunk (-).
    pub up_in_trunk: Vector3<f64>,
    /// Angular rate of the trunk, in its own axes (rad/s), if it is known.
    pub trunk_rate: Option<Vector3<f64>>,
    /// Acceleration of the trunk's origin less gravity, in its own axes (m/s²), if it is known.
    pub specific_force: Option<Vector3<f64>>,
}

impl SupportFrameMeasurement {
    /// Expresses a measurement in support coordinates of the foot on `support`.
    ///
    /// * `up_in_trunk` – the vertical (unit vector), in the axes of the trunk
    /// * `unusable` – groups of the measurement that mean nothing; of them only those of the trunk count here
    pub fn new(
        support: Side,
        mirror: &Mirror,
        measurement: &Measurement,
        up_in_trunk: Vector3<f64>,
        unusable: SensorGroups,
    ) -> Self {
        let (mut angles, mut rates) = (measurement.angles, measurement.rates);
        for joint in [Joint::FootRoll, Joint::FootPitch] {
            angles[joint] = 0.0;
            rates[joint] = 0.0;
        }
        let [support_foot, swing_foot] = support.support_first(measurement.feet);
        let usable = |group, value| (!unusable.contains(group)).then_some(value);
        let trunk_rate = usable(SensorGroup::AngularRate, measurement.angular_rate);
        let specific_force = usable(SensorGroup::SpecificForce, measurement.specific_force);
        let physical = Self { angles, rates, support_foot, swing_foot, up_in_trunk, trunk_rate, specific_force };
        mirror.to_support(support, &physical)
    }

    /// The vertical over the support sole, in the axes of the sole: joints yield, and soles tip or stand on a slope.
    ///
    /// * `kinematics` – of the measured joint angles
    pub fn up_over_sole(&self, kinematics: &Kinematics) -> Vector3<f64> {
        kinematics.rotation[Mechanism::TRUNK] * self.up_in_trunk
    }
}

impl Mirrored for SupportFrameMeasurement {
    fn mirrored(&self, mirror: &Mirror) -> Self {
        let vector = |vector: Vector3<f64>| Vector3::new(vector.x, -vector.y, vector.z);
        Self {
            angles: self.angles.mirrored(mirror),
            rates: self.rates.mirrored(mirror),
            support_foot: self.support_foot.mirrored(mirror),
            swing_foot: self.swing_foot.mirrored(mirror),
            up_in_trunk: vector(self.up_in_trunk),
            trunk_rate: self.trunk_rate.map(|rate| -vector(rate)),
            specific_force: self.specific_force.map(vector),
        }
    }
}
