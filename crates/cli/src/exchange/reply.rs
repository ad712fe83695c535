//! Reply, controller → wire → operator.

use controller::{Answer, Intent, Refusal};
use gait::Quantity;
use wire::{Granted, Reason, Reply, Verdict};

/// The controller's answer, for the wire.
pub fn reply(answer: &Answer) -> Reply {
    let Answer { admission, intent, refusal } = answer;
    let verdict = match admission.verdict {
        _ if refusal.is_some() => Verdict::Refused,
        gait::Verdict::Accepted => Verdict::Accepted,
        gait::Verdict::Limited => Verdict::Limited,
        gait::Verdict::Refused => Verdict::Refused,
    };
    let reason = match (refusal, admission.reason()) {
        (Some(Refusal::Fallen | Refusal::Standing), _) => Reason::NoWayBack,
        (None, Some(reason)) => objection(reason),
        (None, None) => Reason::None,
    };
    let gait::Command { turn, speed, extension } = admission.granted;
    let intent = Some(match intent {
        Intent::Walk => wire::Intent::Walk,
        Intent::Stop => wire::Intent::Stop,
        Intent::Hold => wire::Intent::Hold,
    });
    let granted = Granted { turn, speed, extension, intent };
    Reply { verdict, reason, effect_half_step: admission.effect_half_step, granted }
}

fn objection(reason: gait::Reason) -> Reason {
    match reason {
        gait::Reason::NotFinite(_) => Reason::NotFinite,
        gait::Reason::BelowMin { quantity, .. } | gait::Reason::AboveMax { quantity, .. } => match quantity {
            Quantity::Turn => Reason::TurnLimit,
            Quantity::Speed => Reason::SpeedLimit,
            Quantity::Extension => Reason::ExtensionLimit,
        },
    }
}
