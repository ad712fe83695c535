//! A violated limit of the walk in the words of a reply.

use interface::{ActiveLimit, Objection, Reason};
use pattern::{Limit, LimitViolation};

/// A violated limit in the words of a reply.
pub(crate) fn objection(violation: &LimitViolation) -> Objection {
    let (reason, joint) = match violation.limit {
        Limit::Margin => (Reason::Margin, None),
        Limit::JointRange(joint) => (Reason::JointRange, Some(joint)),
        Limit::JointRate(joint) => (Reason::JointRate, Some(joint)),
        Limit::Torque(joint) => (Reason::Torque, Some(joint)),
        Limit::Voltage(joint) => (Reason::Voltage, Some(joint)),
        Limit::Friction => (Reason::Friction, None),
        Limit::YawTorque => (Reason::YawTorque, None),
        Limit::SoleClearance => (Reason::SoleClearance, None),
        // Value and bound mean nothing.
        Limit::LegReach => return Objection { reason: Reason::LegReach, active_limit: None },
    };
    let active_limit = Some(ActiveLimit { joint, value: violation.value, limit: violation.bound });
    Objection { reason, active_limit }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_violated_joint_limit_is_named_with_its_joint() {
        let joint = model::Joint::RightKnee;
        let violation = LimitViolation { limit: Limit::JointRate(joint), value: 14.0, bound: 12.0 };
        let active_limit = Some(ActiveLimit { joint: Some(joint), value: 14.0, limit: 12.0 });
        assert_eq!(objection(&violation), Objection { reason: Reason::JointRate, active_limit });
    }
}
