//! The sensors whose values in a sample are not used.

use interface::{Fault, Rejection, Sensor, SensorGroup, SensorGroups};
use model::{Joint, Side};

/// Sensors whose values in a sample are not used: each stands for itself, the others go on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct RejectedSensors {
    /// The first one that was found, and why.
    first: Option<Rejection>,
    /// Their groups, but for joints.
    groups: SensorGroups,
    /// The joints whose angle or rate is not used, one bit each by their place in the order.
    joints: u32,
}

impl RejectedSensors {
    /// Rejects a sensor.
    pub(crate) fn insert(&mut self, fault: Fault, sensor: Sensor) {
        self.first = self.first.or(Some(Rejection { fault, sensor }));
        match sensor {
            Sensor::All => {
                SensorGroup::ALL.iter().for_each(|group| self.groups.insert(*group));
                self.joints = u32::MAX;
            }
            Sensor::JointAngle(joint) | Sensor::JointRate(joint) => self.joints |= 1 << joint.index(),
            Sensor::Foot(side) => self.groups.insert(SensorGroup::of_foot(side)),
            Sensor::Feet => Side::BOTH.into_iter().for_each(|side| self.groups.insert(SensorGroup::of_foot(side))),
            Sensor::Orientation => self.groups.insert(SensorGroup::Orientation),
            Sensor::AngularRate => self.groups.insert(SensorGroup::AngularRate),
            Sensor::Accelerometer => self.groups.insert(SensorGroup::SpecificForce),
        }
    }

    /// Does without a group that is not there, which is no fault.
    pub(crate) fn do_without(&mut self, group: SensorGroup) {
        self.groups.insert(group);
    }

    /// Why the first of them was rejected; `None` if no sensor is at fault.
    pub(crate) fn first(&self) -> Option<Rejection> {
        self.first
    }

    /// The groups that are not used, but for joints.
    pub(crate) fn groups(&self) -> SensorGroups {
        self.groups
    }

    /// Whether angle and rate of a joint are not used.
    pub(crate) fn has_joint(&self, joint: Joint) -> bool {
        self.joints & (1 << joint.index()) != 0
    }

    /// Whether the values of any joint are not used.
    pub(crate) fn has_any_joint(&self) -> bool {
        self.joints != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rejected_sensor_leaves_the_others() {
        let mut rejected = RejectedSensors::default();
        rejected.insert(Fault::MeasurementFrozen, Sensor::JointRate(Joint::LeftKnee));
        rejected.insert(Fault::MeasurementNotFinite, Sensor::Foot(Side::Left));
        let first = Rejection { fault: Fault::MeasurementFrozen, sensor: Sensor::JointRate(Joint::LeftKnee) };
        assert_eq!(rejected.first(), Some(first), "the first is told");
        assert_eq!(rejected.groups().iter().collect::<Vec<_>>(), [SensorGroup::LeftFoot]);
        let joints: Vec<_> = Joint::ALL.into_iter().filter(|joint| rejected.has_joint(*joint)).collect();
        assert_eq!(joints, [Joint::LeftKnee]);
    }

    #[test]
    fn a_group_that_is_not_there_is_no_fault() {
        let mut rejected = RejectedSensors::default();
        rejected.do_without(SensorGroup::SpecificForce);
        assert_eq!((rejected.first(), rejected.has_any_joint()), (None, false));
        assert!(rejected.groups().contains(SensorGroup::SpecificForce));
    }
}
