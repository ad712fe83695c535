//! Replies in words, for people and as JSON.

use serde::Serialize;
use wire::{Bound, Reason, Reply, Request, Verdict};

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
    #[serde(skip_serializing_if = "Option::is_none")]
    bound: Option<BoundInJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    in_command: Option<InCommandInJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    predicted_margin_mm: Option<f64>,
}

/// A limit that bound, as JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct BoundInJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<u8>,
    value: f64,
    limit: f64,
    #[serde(skip_serializing_if = "str::is_empty")]
    unit: &'static str,
}

/// Who holds command, as JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct InCommandInJson {
    source: &'static str,
    remaining_s: f64,
}

impl From<&Reply> for ReplyInJson {
    fn from(reply: &Reply) -> Self {
        let granted = &reply.granted;
        Self {
            verdict: reply.verdict.text(),
            reason: (reply.reason != Reason::None).then(|| reply.reason.text()),
            effect_half_step: reply.effect_half_step,
            turn_deg: people(granted.turn.to_degrees()),
            speed: granted.speed,
            extension_deg: people(granted.extension.to_degrees()),
            intent: granted.intent.map(|intent| intent.text()),
            bound: reply.bound.map(|bound| {
                let Unit { per_si, name } = unit(reply.reason);
                let [value, limit] = [bound.value, bound.limit].map(|number| people(number * per_si));
                BoundInJson { joint: bound.joint.map(|joint| joint.number()), value, limit, unit: name.trim_start() }
            }),
            in_command: reply.in_command.map(|in_command| InCommandInJson {
                source: in_command.source.text(),
                remaining_s: people(in_command.remaining),
            }),
            predicted_margin_mm: reply.predicted_margin.map(|margin| people(margin * 1e3)),
        }
    }
}

/// What became of a request, in a line.
pub fn reply(asked: &Request, reply: &Reply) -> String {
    let half_step = reply.effect_half_step;
    let margin = reply.predicted_margin.map(|margin| format!("; predicted least margin {:.1} mm", margin * 1e3));
    let margin = margin.unwrap_or_default();
    match reply.verdict {
        Verdict::Accepted => format!("accepted: {}, from half-step {half_step}{margin}", what(asked, reply)),
        Verdict::Limited => {
            let (what, why) = (what(asked, reply), why(asked, reply));
            format!("limited to {what} because {why}; takes effect at half-step {half_step}{margin}")
        }
        Verdict::Refused => format!("refused because {}", why(asked, reply)),
    }
}

/// What stood against it, with numbers where there are any.
fn why(asked: &Request, reply: &Reply) -> String {
    if let Some(wire::InCommand { source, remaining }) = reply.in_command {
        let asking = asked.source;
        return format!(
            "{source} is in command and goes before {asking}, for another {remaining:.2} s if it says no more"
        );
    }
    let Some(Bound { joint, value, limit }) = reply.bound else { return reply.reason.to_string() };
    let Unit { per_si, name } = unit(reply.reason);
    let [value, limit] = [value, limit].map(|number| (number * per_si * 1e3).round() / 1e3 + 0.0);
    let joint = joint.map(|joint| format!("joint {} ({}) ", joint.number(), joint.name())).unwrap_or_default();
    format!("{} ({joint}{value}{name}, limit {limit}{name})", reply.reason)
}

/// In what a person reads the limit of a reason.
struct Unit {
    /// How many of it one SI unit is.
    per_si: f64,
    /// As it follows a number.
    name: &'static str,
}

fn unit(reason: Reason) -> Unit {
    const DEGREES: f64 = 180.0 / std::f64::consts::PI;
    let (per_si, name) = match reason {
        Reason::TurnLimit | Reason::ExtensionLimit | Reason::JointRange => (DEGREES, "°"),
        Reason::JointRate => (DEGREES, " °/s"),
        Reason::Torque => (1.0, " N·m"),
        Reason::Voltage => (1.0, " V"),
        Reason::Margin | Reason::SoleClearance | Reason::LegReach => (1e3, " mm"),
        // The speed is a factor; the others are no limits.
        Reason::SpeedLimit
        | Reason::None
        | Reason::NotFinite
        | Reason::NoWayBack
        | Reason::QueueFull
        | Reason::NotUnderstood
        | Reason::Empty
        | Reason::ShuttingDown
        | Reason::Outranked
        | Reason::Superseded
        | Reason::Fallen
        | Reason::Faulted
        | Reason::NotWell => (1.0, ""),
    };
    Unit { per_si, name }
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
    use model::Joint;
    use wire::{Granted, InCommand, Source};

    use super::*;

    fn answer(verdict: Verdict, reason: Reason) -> Reply {
        let granted = Granted { turn: 10_f64.to_radians(), speed: 1.0, extension: 0.0, intent: None };
        Reply { verdict, ..Reply::refused(reason, 12, granted) }
    }

    #[test]
    fn it_names_the_limit_with_joint_and_numbers() {
        let asked = Request { speed: Some(1.5), ..Request::by(Source::Script) };
        let rate = Bound { joint: Some(Joint::RightKnee), value: 14.5_f64.to_radians(), limit: 12_f64.to_radians() };
        let limited = answer(Verdict::Limited, Reason::JointRate);
        let limited = Reply { bound: Some(rate), predicted_margin: Some(0.0214), ..limited };
        assert_eq!(
            reply(&asked, &limited),
            "limited to speed 1 because a joint would move too fast (joint 5 (right_knee) 14.5 °/s, limit 12 °/s); \
             takes effect at half-step 12; predicted least margin 21.4 mm"
        );
        let json = serde_json::to_value(ReplyInJson::from(&limited)).unwrap();
        let bound = serde_json::json!({"joint": 5, "value": 14.5, "limit": 12.0, "unit": "°/s"});
        assert_eq!((&json["bound"], &json["predicted_margin_mm"]), (&bound, &21.4.into()));

        let bound = Some(Bound { joint: None, value: 9.0, limit: 1.4 });
        assert_eq!(
            reply(&asked, &Reply { bound, ..answer(Verdict::Refused, Reason::SpeedLimit) }),
            "refused because the speed is outside what this walk can do (9, limit 1.4)"
        );
    }

    #[test]
    fn it_names_who_is_in_command() {
        let asked = Request { speed: Some(1.5), ..Request::by(Source::Script) };
        let in_command = Some(InCommand { source: Source::Teleop, remaining: 0.4201 });
        let refused = Reply { in_command, ..answer(Verdict::Refused, Reason::Outranked) };
        assert_eq!(
            reply(&asked, &refused),
            "refused because teleop is in command and goes before script, for another 0.42 s if it says no more"
        );
        let json = serde_json::to_value(ReplyInJson::from(&refused)).unwrap();
        assert_eq!(json["in_command"], serde_json::json!({"source": "teleop", "remaining_s": 0.4201}));
    }

    #[test]
    fn it_says_what_why_and_when() {
        let asked = Request { turn: Some(15_f64.to_radians()), ..Request::by(Source::Console) };
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
