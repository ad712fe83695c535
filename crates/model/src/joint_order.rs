//! The order of a mechanism's joints from the ground outward.

use crate::{Joint, PerJoint, Side};

/// First place of the right leg, of the left leg, and of the upper body.
const LEGS: [usize; 2] = [2, 8];
const UPPER_BODY: usize = 14;
/// Places of the feet.
const FEET: [usize; 2] = [1, 13];

/// All joints of a mechanism, parents before their children.
///
/// The places are the same for every robot: the unpowered foot (0, 1), the right leg from the ankle up (2 to 7), the
/// left leg from the hip down (8 to 13), waist and arms (14 to 19). Which joint of a hip or an ankle comes first
/// differs from robot to robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointOrder([Joint; Joint::COUNT]);

impl JointOrder {
    /// The number of links from the right sole to the pelvis.
    pub const UP_TO_PELVIS: usize = LEGS[1];
    /// The number of links from the right sole over the pelvis to the left sole.
    pub const UP_TO_LEFT_FOOT: usize = UPPER_BODY;

    /// The places of the joints of a leg.
    #[inline(always)]
    pub const fn places_of_leg(side: Side) -> std::ops::Range<usize> {
        let first = LEGS[side.index()];
        first..first + 6
    }

    /// The order of the paper's robot, that of [`Joint::ALL`].
    pub const OF_THE_PAPER: Self = Self(Joint::ALL);

    /// The order that follows from each joint's parent; `None` if the legs are not one chain from foot to foot, with
    /// the joints of one ankle, the knee and the joints of the hip after each other, or if there is a cycle.
    pub fn from_parents(parents: &PerJoint<Option<Joint>>) -> Option<Self> {
        let mut order = Joint::ALL;
        for place in 1..Joint::COUNT {
            let block = if place < UPPER_BODY { place..UPPER_BODY } else { place..Joint::COUNT };
            let next = block.into_iter().find(|&other| match parents[order[other]] {
                Some(parent) if place < UPPER_BODY => parent == order[place - 1],
                Some(parent) => order[..place].contains(&parent),
                None => false,
            })?;
            order[place..=next].rotate_right(1);
        }
        let order = Self(order);
        let same_leg = |side: Side| {
            let paper = Self::OF_THE_PAPER.leg(side);
            order.leg(side).iter().all(|joint| paper.contains(joint))
        };
        let knees_in_the_middle = order.0[4] == Joint::RightKnee && order.0[11] == Joint::LeftKnee;
        let foot_first = order.0[0] == Joint::FootRoll && order.0[1] == Joint::FootPitch;
        (foot_first && knees_in_the_middle && Side::BOTH.into_iter().all(same_leg)).then_some(order)
    }

    /// All joints.
    #[inline(always)]
    pub const fn all(&self) -> &[Joint; Joint::COUNT] {
        &self.0
    }

    /// Where in the order a joint is.
    pub fn place(&self, joint: Joint) -> usize {
        self.0.iter().position(|other| *other == joint).unwrap_or(joint.index())
    }

    /// The six joints of a leg: from the ankle up for the right one, from the hip down for the left one.
    #[inline(always)]
    pub fn leg(&self, side: Side) -> [Joint; 6] {
        let first = LEGS[side.index()];
        std::array::from_fn(|place| self.0[first + place])
    }

    /// The joint whose link is the pelvis.
    #[inline(always)]
    pub const fn pelvis(&self) -> Joint {
        self.0[Self::UP_TO_PELVIS - 1]
    }

    /// The joint whose link is the foot on `side`.
    #[inline(always)]
    pub const fn foot(&self, side: Side) -> Joint {
        self.0[FEET[side.index()]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parents_of(order: [Joint; Joint::COUNT]) -> PerJoint<Option<Joint>> {
        let mut parents = PerJoint([None; Joint::COUNT]);
        for pair in order.windows(2) {
            parents[pair[1]] = Some(pair[0]);
        }
        parents[Joint::WaistPitch] = Some(order[7]);
        for shoulder in [Joint::RightShoulder, Joint::LeftShoulder] {
            parents[shoulder] = Some(Joint::WaistRoll);
        }
        parents
    }

    #[test]
    fn the_order_follows_from_the_parents() {
        assert_eq!(JointOrder::from_parents(&parents_of(Joint::ALL)), Some(JointOrder::OF_THE_PAPER));
        let mut other = Joint::ALL;
        other[2..4].reverse();
        other[12..14].reverse();
        other[5..8].rotate_left(1);
        other[8..11].rotate_right(1);
        let order = JointOrder::from_parents(&parents_of(other)).unwrap();
        assert_eq!(order.all(), &other);
        assert_eq!(order.pelvis(), other[7]);
        assert_eq!(order.foot(Side::Left), other[13]);
        assert_eq!(order.leg(Side::Right), other[2..8]);
    }

    #[test]
    fn chains_that_are_no_legs_have_no_order() {
        let mut cycle = parents_of(Joint::ALL);
        cycle[Joint::RightKnee] = Some(Joint::RightKnee);
        assert_eq!(JointOrder::from_parents(&cycle), None);
        let mut misplaced = Joint::ALL;
        misplaced.swap(4, 5);
        assert_eq!(JointOrder::from_parents(&parents_of(misplaced)), None);
        let mut mixed = Joint::ALL;
        mixed.swap(7, 8);
        assert_eq!(JointOrder::from_parents(&parents_of(mixed)), None);
    }
}
