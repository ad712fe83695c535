//! The limits of the robot that a motion must keep, and by how much it exceeds each of them.

use model::{Joint, JointVector};

/// A limit of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Distance of the ZMP to the edge of the sole (m). It bounds the ankle torques, too: a sole whose ZMP is at the
    /// edge transmits no more.
    Margin,
    /// Angle of a physical joint (rad).
    JointRange(Joint),
    /// Rate of a physical joint (rad/s).
    JointRate(Joint),
    /// Torque of a physical joint's motor (N·m).
    Torque(Joint),
    /// Voltage of a physical joint's motor (V).
    Voltage(Joint),
    /// Horizontal force of the ground per vertical force (-): beyond the friction the sole slips.
    Friction,
    /// Moment of the ground on the support sole about the vertical (N·m): beyond the friction the sole spins.
    YawTorque,
    /// Distance of the swing sole to the support sole, or to the ground in mid-swing (m).
    SoleClearance,
    /// Length of a leg, which was too short for a posture; value and bound mean nothing.
    LegReach,
}

/// The joints that feel directly where the ground pushes: their torques are limited by what the ground can push, too.
pub(crate) const ANKLES: [Joint; 4] =
    [Joint::RightAnkleRoll, Joint::RightAnklePitch, Joint::LeftAnklePitch, Joint::LeftAnkleRoll];

/// A limit that is violated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitViolation {
    /// Which limit.
    pub limit: Limit,
    /// The value that the motion needs, in the unit of the limit.
    pub value: f64,
    /// The bound on this value, in the unit of the limit.
    pub bound: f64,
}

/// How far each limit is exceeded at most, in the unit of the limit; 0 where it is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Excess {
    margin: f64,
    range: JointVector,
    rate: JointVector,
    torque: JointVector,
    voltage: JointVector,
    friction: f64,
    yaw_torque: f64,
    clearance: f64,
    /// 1 if a leg was too short for a posture.
    reach: f64,
}

/// Loss of margin that counts as none (m).
const MARGIN_LOSS_MAX: f64 = 0.002;
/// Relative increase of another excess that counts as none.
const INCREASE_MAX: f64 = 0.02;

impl Excess {
    pub(crate) const NONE: Self = Self {
        margin: 0.0,
        range: JointVector::ZERO,
        rate: JointVector::ZERO,
        torque: JointVector::ZERO,
        voltage: JointVector::ZERO,
        friction: 0.0,
        yaw_torque: 0.0,
        clearance: 0.0,
        reach: 0.0,
    };

    /// Notes a violation.
    pub(crate) fn note(&mut self, violation: &LimitViolation) {
        let excess = match violation.limit {
            Limit::Margin => &mut self.margin,
            Limit::JointRange(joint) => &mut self.range[joint],
            Limit::JointRate(joint) => &mut self.rate[joint],
            Limit::Torque(joint) => &mut self.torque[joint],
            Limit::Voltage(joint) => &mut self.voltage[joint],
            Limit::Friction => &mut self.friction,
            Limit::YawTorque => &mut self.yaw_torque,
            Limit::SoleClearance => &mut self.clearance,
            Limit::LegReach => &mut self.reach,
        };
        let by = if violation.limit == Limit::LegReach { 1.0 } else { (violation.value - violation.bound).abs() };
        *excess = excess.max(by);
    }

    /// The larger excess of each limit.
    pub(crate) fn max(&self, other: &Excess) -> Self {
        let joints = |ours: &JointVector, theirs: &JointVector| ours.zip_with(theirs, f64::max);
        Self {
            margin: self.margin.max(other.margin),
            range: joints(&self.range, &other.range),
            rate: joints(&self.rate, &other.rate),
            torque: joints(&self.torque, &other.torque),
            voltage: joints(&self.voltage, &other.voltage),
            friction: self.friction.max(other.friction),
            yaw_torque: self.yaw_torque.max(other.yaw_torque),
            clearance: self.clearance.max(other.clearance),
            reach: self.reach.max(other.reach),
        }
    }

    /// Whether no limit is exceeded further than in `other`.
    pub(crate) fn is_within(&self, other: &Excess) -> bool {
        let is_within = |ours: f64, theirs: f64| ours <= theirs * (1.0 + INCREASE_MAX);
        let all_within = |ours: &JointVector, theirs: &JointVector| {
            Joint::ALL.into_iter().all(|joint| is_within(ours[joint], theirs[joint]))
        };
        let margin_loss_max = if other.margin > 0.0 { MARGIN_LOSS_MAX } else { 0.0 };
        self.margin <= other.margin + margin_loss_max
            && all_within(&self.range, &other.range)
            && all_within(&self.rate, &other.rate)
            && all_within(&self.torque, &other.torque)
            && all_within(&self.voltage, &other.voltage)
            && is_within(self.friction, other.friction)
            && is_within(self.yaw_torque, other.yaw_torque)
            && is_within(self.clearance, other.clearance)
            && is_within(self.reach, other.reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exceeding(violations: &[(Limit, f64, f64)]) -> Excess {
        let mut excess = Excess::NONE;
        for &(limit, value, bound) in violations {
            excess.note(&LimitViolation { limit, value, bound });
        }
        excess
    }

    /// What one limit is exceeded by excuses no other one.
    #[test]
    fn each_limit_is_compared_by_itself() {
        let knee = Joint::RightKnee;
        let violations = [
            (Limit::Margin, -0.01, 0.0),
            (Limit::JointRange(knee), 2.2, 2.1),
            (Limit::JointRate(knee), -9.0, -8.0),
            (Limit::Torque(knee), 400.0, 368.0),
            (Limit::Voltage(knee), 50.0, 48.0),
            (Limit::Friction, 0.7, 0.6),
            (Limit::YawTorque, -60.0, -50.0),
            (Limit::SoleClearance, 0.01, 0.02),
            (Limit::LegReach, 0.0, 0.0),
        ];
        let all_but = |left_out: usize| -> Vec<_> {
            (0..violations.len()).filter(|&index| index != left_out).map(|index| violations[index]).collect()
        };
        let all = exceeding(&violations);
        assert!(all.is_within(&all));
        for (index, violation) in violations.iter().enumerate() {
            assert!(!exceeding(&[*violation]).is_within(&exceeding(&all_but(index))), "{violation:?}");
            assert!(exceeding(&all_but(index)).is_within(&all), "{violation:?}");
        }
        let other_knee = exceeding(&[(Limit::Voltage(Joint::LeftKnee), 60.0, 48.0)]);
        assert!(!exceeding(&[violations[4]]).is_within(&other_knee));
    }

    #[test]
    fn the_worst_value_counts() {
        let voltage = |value| (Limit::Voltage(Joint::RightKnee), value, 48.0);
        assert_eq!(exceeding(&[voltage(55.0), voltage(49.0)]), exceeding(&[voltage(55.0)]));
        assert!(!exceeding(&[voltage(55.0)]).is_within(&exceeding(&[voltage(49.0)])));
    }
}
