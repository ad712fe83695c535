//! What a joint does in the mechanism.

use model::Side;

use crate::side_name::side_name;

/// What a joint of a leg does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LegRole {
    /// Turns the leg about z.
    HipYaw,
    /// Swings the leg sideways, about x.
    HipRoll,
    /// Swings the leg forward and backward, about y.
    HipPitch,
    /// Bends the leg, about y.
    Knee,
    /// Tips the foot over heel and toe, about y.
    AnklePitch,
    /// Tips the foot sideways, about x.
    AnkleRoll,
}

/// What a joint of the mechanism does: the name of its table in the mechanism file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JointRole {
    /// A joint of a leg.
    Leg(Side, LegRole),
    /// Tips the trunk forward.
    WaistPitch,
    /// Tips the trunk sideways.
    WaistRoll,
    /// A shoulder.
    Shoulder(Side),
    /// An elbow.
    Elbow(Side),
}

impl LegRole {
    /// All, from the hip down, the hip in the built-in robot's order.
    pub const ALL: [LegRole; 6] =
        [LegRole::HipRoll, LegRole::HipYaw, LegRole::HipPitch, LegRole::Knee, LegRole::AnklePitch, LegRole::AnkleRoll];

    /// The role's name: `hip_yaw`.
    pub const fn name(self) -> &'static str {
        match self {
            LegRole::HipYaw => "hip_yaw",
            LegRole::HipRoll => "hip_roll",
            LegRole::HipPitch => "hip_pitch",
            LegRole::Knee => "knee",
            LegRole::AnklePitch => "ankle_pitch",
            LegRole::AnkleRoll => "ankle_roll",
        }
    }

    /// Which of the axes x, y, z (0, 1, 2) it turns about, more or less.
    pub const fn axis(self) -> usize {
        match self {
            LegRole::HipRoll | LegRole::AnkleRoll => 0,
            LegRole::HipPitch | LegRole::Knee | LegRole::AnklePitch => 1,
            LegRole::HipYaw => 2,
        }
    }
}

impl JointRole {
    /// All roles that a joint of a URDF can have, in the order of the numbers in the mechanism file.
    pub fn all() -> impl Iterator<Item = JointRole> {
        let right = LegRole::ALL.into_iter().rev().map(|role| JointRole::Leg(Side::Right, role));
        let left = LegRole::ALL.into_iter().map(|role| JointRole::Leg(Side::Left, role));
        let arms = Side::BOTH.into_iter().flat_map(JointRole::of_arm);
        right.chain(left).chain([JointRole::WaistPitch, JointRole::WaistRoll]).chain(arms)
    }

    /// The roles of an arm, from the trunk outward.
    pub const fn of_arm(side: Side) -> [JointRole; 2] {
        [JointRole::Shoulder(side), JointRole::Elbow(side)]
    }

    /// The name of its table in map and mechanism file: `right_knee`.
    pub fn name(self) -> String {
        match self {
            JointRole::Leg(side, role) => format!("{}_{}", side_name(side), role.name()),
            JointRole::WaistPitch => "waist_pitch".into(),
            JointRole::WaistRoll => "waist_roll".into(),
            JointRole::Shoulder(side) => format!("{}_shoulder", side_name(side)),
            JointRole::Elbow(side) => format!("{}_elbow", side_name(side)),
        }
    }

    /// Its number in the mechanism file, 3 to 20.
    pub fn number(self) -> usize {
        JointRole::all().position(|role| role == self).unwrap_or_default() + 3
    }

    /// The name that it shares with the joint on the other side: `knee`.
    pub fn name_of_both(self) -> String {
        match self {
            JointRole::Leg(_, role) => role.name().into(),
            JointRole::Shoulder(_) => "shoulder".into(),
            JointRole::Elbow(_) => "elbow".into(),
            JointRole::WaistPitch | JointRole::WaistRoll => self.name(),
        }
    }

    /// Which of the axes x, y, z (0, 1, 2) it turns about, more or less.
    pub const fn axis(self) -> usize {
        match self {
            JointRole::Leg(_, role) => role.axis(),
            JointRole::WaistPitch | JointRole::Shoulder(_) | JointRole::Elbow(_) => 1,
            JointRole::WaistRoll => 0,
        }
    }

    /// Whether it belongs to an arm.
    pub const fn is_in_arm(self) -> bool {
        matches!(self, JointRole::Shoulder(_) | JointRole::Elbow(_))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_are_those_of_the_mechanism_file() {
        for joint in model::Joint::ALL.into_iter().skip(2) {
            let role = JointRole::all().find(|role| role.name() == joint.name()).unwrap();
            assert_eq!(role.number(), usize::from(joint.number()));
        }
    }
}
