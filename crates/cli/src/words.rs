//! Replies in words, for people and as JSON.

use serde::Serialize;
use wire::{Reply, Request, Verdict};

/// A reply as JSON; angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReplyInJson {
    verdict: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
    effect_half_step: u64,
    turn_deg: f64,
    speed: f64,
    extension_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    intent: Option<&'static str>,
}

impl From<&Reply> for ReplyInJson {
    fn from(reply: &Reply) -> Self {
        let granted = &reply.granted;
        Self {
            verdict: reply.verdict.text(),
            reason: (reply.reason != wire::Reason::None).then(|| reply.reason.text()),
            effect_half_step: reply.effect_half_step,
            turn_deg: people(granted.turn.to_degrees()),
            speed: granted.speed,
            extension_deg: people(granted.extension.to_degrees()),
            intent: granted.intent.map(|intent| intent.text()),
        }
    }
}

/// What became of a request, in a line.
pub fn reply(asked: &Request, reply: &Reply) -> String {
    let (reason, half_step) = (reply.reason, reply.effect_half_step);
    match reply.verdict {
        Verdict::Accepted => format!("accepted: {}, from half-step {half_step}", what(asked, reply)),
        Verdict::Limited => {
            format!("limited to {} because {reason}; takes effect at half-step {half_step}", what(asked, reply))
        }
        Verdict::Refused => format!("refused because {reason}"),
    }
}

/// What was granted of what was asked.
fn what(asked: &Request, reply: &Reply) -> String {
    let granted = &reply.granted;
    let angle = |name: &str, angle: f64| format!("{name} {}°", people(angle.to_degrees()));
    let parts = [
        asked.turn.map(|_| angle("turn", granted.turn)),
        asked.speed.map(|_| format!("speed {}", people(granted.speed))),
        asked.extension.map(|_| angle("extension", granted.extension)),
        asked.intent.map(|intent| intent.text().to_owned()),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// A number without the noise of the last binary digits and without `-0`.
fn people(value: f64) -> f64 {
    (value * 1e9).round() / 1e9 + 0.0
}

#[cfg(test)]
mod tests {
    use wire::{Granted, Reason};

    use super::*;

    fn answer(verdict: Verdict, reason: Reason) -> Reply {
        let granted = Granted { turn: 10_f64.to_radians(), speed: 1.0, extension: 0.0, intent: None };
        Reply { verdict, reason, effect_half_step: 12, granted }
    }

    #[test]
    fn it_says_what_why_and_when() {
        let asked = Request { turn: Some(15_f64.to_radians()), ..Request::by(wire::Source::Console) };
        assert_eq!(
            reply(&asked, &answer(Verdict::Limited, Reason::TurnLimit)),
            "limited to turn 10° because the turn is larger than this walk can do; takes effect at half-step 12"
        );
        assert_eq!(reply(&asked, &answer(Verdict::Accepted, Reason::None)), "accepted: turn 10°, from half-step 12");
        assert_eq!(
            reply(&asked, &answer(Verdict::Refused, Reason::NoWayBack)),
            "refused because this walk cannot go on any more: start a new one"
        );
    }
}
