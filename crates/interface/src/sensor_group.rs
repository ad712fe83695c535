//! The groups of a measurement's values that can be there or missing, each by itself.

use model::Side;

use crate::code::codes;

codes! {
    /// A group of a measurement's values; its number is its bit in [`SensorGroups`].
    SensorGroup {
        /// Angles and rates of all joints.
        Joints = 1 "angles and rates of the joints",
        /// Orientation of the trunk.
        Orientation = 2 "orientation of the trunk",
        /// Angular rate of the trunk.
        AngularRate = 4 "angular rate of the trunk",
        /// Specific force at the trunk.
        SpecificForce = 8 "accelerometer of the trunk",
        /// Wrench on the right foot.
        RightFoot = 16 "force sensor of the right foot",
        /// Wrench on the left foot.
        LeftFoot = 32 "force sensor of the left foot",
    }
}

impl SensorGroup {
    /// The force sensor of a foot.
    pub const fn of_foot(side: Side) -> Self {
        [Self::RightFoot, Self::LeftFoot][side.index()]
    }
}

/// A set of groups of values, one bit each. Bits unknown to this version are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SensorGroups(pub u32);

impl SensorGroups {
    /// No group.
    pub const NONE: Self = Self(0);

    /// Adds a group.
    pub fn insert(&mut self, group: SensorGroup) {
        self.0 |= group.code();
    }

    /// Takes a group out.
    pub fn remove(&mut self, group: SensorGroup) {
        self.0 &= !group.code();
    }

    /// Whether a group is in the set.
    pub fn contains(self, group: SensorGroup) -> bool {
        self.0 & group.code() != 0
    }

    /// The groups in the set.
    pub fn iter(self) -> impl Iterator<Item = SensorGroup> {
        SensorGroup::ALL.iter().copied().filter(move |group| self.contains(*group))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_group_has_a_bit_of_its_own() {
        let mut all = SensorGroups::NONE;
        SensorGroup::ALL.iter().for_each(|group| all.insert(*group));
        assert_eq!(all.0.count_ones() as usize, SensorGroup::ALL.len());
        assert_eq!(all.iter().collect::<Vec<_>>(), SensorGroup::ALL);
        all.remove(SensorGroup::Orientation);
        assert!(!all.contains(SensorGroup::Orientation) && all.contains(SensorGroup::AngularRate));
    }

    #[test]
    fn a_foot_is_that_of_its_side() {
        assert_eq!(Side::BOTH.map(SensorGroup::of_foot), [SensorGroup::RightFoot, SensorGroup::LeftFoot]);
    }
}
