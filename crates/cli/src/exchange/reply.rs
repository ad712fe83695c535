//! Reply, controller → wire → operator.

use balance::preview::{Limit, Strain};
use controller::{Answer, Intent, Outranked, Refusal};
use gait::Quantity;
use wire::{Bound, Granted, InCommand, Reason, Reply, Verdict};

use super::source;

/// The controller's answer, for the wire.
pub fn reply(answer: &Answer) -> Reply {
    let Answer { admission, strain, predicted_margin, intent, refusal } = answer;
    let verdict = match admission.verdict {
        _ if refusal.is_some() => Verdict::Refused,
        gait::Verdict::Accepted => Verdict::Accepted,
        gait::Verdict::Limited => Verdict::Limited,
        gait::Verdict::Refused => Verdict::Refused,
    };
    let (reason, bound) = match (refusal, strain, admission.reason()) {
        (Some(Refusal::Fallen), ..) => (Reason::Fallen, None),
        (Some(Refusal::Faulted), ..) => (Reason::Faulted, None),
        (Some(Refusal::NotWell), ..) => (Reason::NotWell, None),
        (Some(Refusal::Standing), ..) => (Reason::NoWayBack, None),
        (Some(Refusal::Outranked(_)), ..) => (Reason::Outranked, None),
        (None, Some(strain), _) => strained(strain),
        (None, None, Some(reason)) => objection(reason),
        (None, None, None) => (Reason::None, None),
    };
    let in_command = match *refusal {
        Some(Refusal::Outranked(Outranked { by, remaining })) => {
            Some(InCommand { source: source::for_wire(by), remaining })
        }
        _ => None,
    };
    let gait::Command { turn, speed, extension } = admission.granted;
    let intent = Some(match intent {
        Intent::Walk => wire::Intent::Walk,
        Intent::Stop => wire::Intent::Stop,
        Intent::Hold => wire::Intent::Hold,
        Intent::Reset => wire::Intent::Reset,
        Intent::InPlace => wire::Intent::InPlace,
    });
    let granted = Granted { turn, speed, extension, intent };
    let effect_half_step = admission.effect_half_step;
    Reply { verdict, reason, effect_half_step, granted, bound, in_command, predicted_margin: *predicted_margin }
}

fn strained(strain: &Strain) -> (Reason, Option<Bound>) {
    let (reason, joint) = match strain.limit {
        Limit::Margin => (Reason::Margin, None),
        Limit::JointRange(joint) => (Reason::JointRange, Some(joint)),
        Limit::JointRate(joint) => (Reason::JointRate, Some(joint)),
        Limit::Voltage(joint) => (Reason::Voltage, Some(joint)),
        Limit::SoleClearance => (Reason::SoleClearance, None),
        Limit::LegReach => return (Reason::LegReach, None),
    };
    (reason, Some(Bound { joint, value: strain.value, limit: strain.bound }))
}

fn objection(reason: gait::Reason) -> (Reason, Option<Bound>) {
    let (quantity, value, limit) = match reason {
        gait::Reason::NotFinite(_) => return (Reason::NotFinite, None),
        gait::Reason::BelowMin { quantity, asked, min } => (quantity, asked, min),
        gait::Reason::AboveMax { quantity, asked, max } => (quantity, asked, max),
    };
    let reason = match quantity {
        Quantity::Turn => Reason::TurnLimit,
        Quantity::Speed => Reason::SpeedLimit,
        Quantity::Extension => Reason::ExtensionLimit,
    };
    (reason, Some(Bound { joint: None, value, limit }))
}

#[cfg(test)]
mod tests {
    use controller::Source;
    use gait::{Admission, Command};

    use super::*;

    const ADMISSION: Admission = Admission {
        verdict: gait::Verdict::Accepted,
        reasons: [None; 3],
        granted: Command::NOMINAL,
        effect_half_step: 7,
    };

    const ANSWER: Answer =
        Answer { admission: ADMISSION, strain: None, predicted_margin: None, intent: Intent::Walk, refusal: None };

    #[test]
    fn a_strain_comes_with_its_joint() {
        let limit = Limit::JointRate(model::Joint::RightKnee);
        let admission = Admission { verdict: gait::Verdict::Limited, ..ADMISSION };
        let strain = Some(Strain { limit, value: 14.0, bound: 12.0 });
        let reply = reply(&Answer { admission, strain, predicted_margin: Some(0.02), ..ANSWER });
        assert_eq!((reply.verdict, reply.reason), (Verdict::Limited, Reason::JointRate));
        assert_eq!(reply.bound, Some(Bound { joint: Some(model::Joint::RightKnee), value: 14.0, limit: 12.0 }));
        assert_eq!(reply.predicted_margin, Some(0.02));
    }

    #[test]
    fn a_limit_comes_with_its_numbers() {
        let above = gait::Reason::AboveMax { quantity: Quantity::Speed, asked: 9.0, max: 1.4 };
        let admission = Admission { verdict: gait::Verdict::Limited, reasons: [None, Some(above), None], ..ADMISSION };
        let reply = reply(&Answer { admission, intent: Intent::Walk, ..ANSWER });
        assert_eq!((reply.verdict, reply.reason), (Verdict::Limited, Reason::SpeedLimit));
        assert_eq!(reply.bound, Some(Bound { joint: None, value: 9.0, limit: 1.4 }));
        assert_eq!(reply.in_command, None);
    }

    #[test]
    fn who_is_outranked_is_told_by_whom() {
        let refusal = Some(Refusal::Outranked(Outranked { by: Source::Teleop, remaining: 0.25 }));
        let reply = reply(&Answer { refusal, ..ANSWER });
        assert_eq!((reply.verdict, reply.reason), (Verdict::Refused, Reason::Outranked));
        assert_eq!(reply.in_command, Some(InCommand { source: wire::Source::Teleop, remaining: 0.25 }));
    }
}
