//! Replies as text for users, and as JSON.

use interface::{ActiveLimit, ControlAuthority, Reason, Reply, Request, SteadyWalk, Verdict, WalkVelocity};
use serde::Serialize;

use crate::destination_text::{destination_text, metres, place_text, places_text};
use crate::limit_unit::LimitUnit;

/// A reply as JSON; angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReplyJson {
    /// The request's id; absent if the sender chose none.
    #[serde(skip_serializing_if = "is_zero")]
    id: u64,
    verdict: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
    effect_half_step: u64,
    turn_deg: f64,
    speed: f64,
    extension_deg: f64,
    sidestep_deg: f64,
    /// How far ahead of the other foot each foot lands (m).
    step_ahead_m: f64,
    /// How far a full step goes aside (m).
    step_aside_m: f64,
    /// Mean velocity (m/s, °/s).
    vx: f64,
    vy: f64,
    wz_deg_s: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    intent: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bound: Option<BoundInJson>,
    /// The way-point or footstep that the reason is about, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<u32>,
    /// Foreseen time until the robot stands at its destination (s).
    #[serde(skip_serializing_if = "Option::is_none")]
    arrival_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    in_command: Option<InCommandInJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    predicted_margin_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mode: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<FaultInJson>,
}

/// The latched fault, as JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct FaultInJson {
    fault: String,
    time_s: f64,
}

fn is_zero(id: &u64) -> bool {
    *id == 0
}

/// The active limit of a request, as JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct BoundInJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<u8>,
    value: f64,
    limit: f64,
    #[serde(skip_serializing_if = "str::is_empty")]
    unit: &'static str,
}

/// The source that holds command, as JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct InCommandInJson {
    source: &'static str,
    remaining_s: f64,
}

impl From<&Reply> for ReplyJson {
    fn from(reply: &Reply) -> Self {
        let granted = &reply.granted;
        Self {
            id: reply.id,
            verdict: reply.verdict.text(),
            reason: (reply.reason != Reason::None).then(|| reply.reason.text()),
            effect_half_step: reply.effect_half_step,
            turn_deg: rounded(granted.turn.to_degrees()),
            speed: granted.speed,
            extension_deg: rounded(granted.extension.to_degrees()),
            sidestep_deg: rounded(granted.sidestep.to_degrees()),
            step_ahead_m: to_micro(reply.walk.step_ahead),
            step_aside_m: to_micro(reply.walk.step_aside),
            vx: to_micro(reply.walk.velocity.ahead),
            vy: to_micro(reply.walk.velocity.left),
            wz_deg_s: to_micro(reply.walk.velocity.turn.to_degrees()),
            intent: reply.intent.map(|intent| intent.text()),
            bound: reply.active_limit.map(|bound| {
                let LimitUnit { per_si, name } = LimitUnit::of(reply.reason);
                let [value, limit] = [bound.value, bound.limit].map(|number| rounded(number * per_si));
                BoundInJson { joint: bound.joint.map(|joint| joint.number()), value, limit, unit: name.trim_start() }
            }),
            place: reply.place,
            arrival_s: reply.arrival.map(to_micro),
            in_command: reply.authority.map(|in_command| InCommandInJson {
                source: in_command.source.text(),
                remaining_s: rounded(in_command.remaining),
            }),
            predicted_margin_mm: reply.predicted_margin.map(|margin| rounded(margin * 1e3)),
            mode: reply.mode.map(|mode| mode.text()),
            fault: reply
                .latched
                .map(|latched| FaultInJson { fault: latched.text(), time_s: (latched.time * 1e3).round() / 1e3 }),
        }
    }
}

/// The reply to a request as a line of text.
pub fn reply_text(request: &Request, reply: &Reply) -> String {
    let from = format!("from half-step {}", reply.effect_half_step);
    let margin = reply.predicted_margin.map(|margin| format!("; predicted ZMP margin {:.1} mm", margin * 1e3));
    let after = margin.unwrap_or_default() + &other_in_control_text(request, reply);
    match reply.verdict {
        Verdict::Accepted => format!("accepted: {}, {from}{after}", granted_text(request, reply)),
        Verdict::Limited => {
            let (granted, objection) = (granted_text(request, reply), objection_text(request, reply));
            format!("limited to {granted}, {from}: {objection}{after}")
        }
        Verdict::Refused => format!("refused: {}", objection_text(request, reply)),
    }
}

/// Whose stream stays in control beside a granted request, which its end would undo.
fn other_in_control_text(request: &Request, reply: &Reply) -> String {
    match reply.authority {
        Some(ControlAuthority { source, .. }) if reply.reason != Reason::Outranked && request.destination.is_none() => {
            format!("; the stream of `{source}` stays in control: the robot stops if it falls silent")
        }
        _ => String::new(),
    }
}

/// What is requested, in words: `turn 15°, speed 1.2`.
pub fn request_text(request: &Request) -> String {
    let angle = |name: &str, angle: Option<f64>| angle.map(|angle| format!("{name} {}°", rounded(angle.to_degrees())));
    let velocity = |WalkVelocity { ahead, left, turn }: WalkVelocity| {
        let [ahead, left, turn] = [ahead, left, turn.to_degrees()].map(|number| (number * 1e3).round() / 1e3 + 0.0);
        format!("vx {ahead} m/s, vy {left} m/s, wz {turn} °/s")
    };
    let parts = [
        angle("turn", request.gait.turn),
        request.gait.speed.map(|speed| format!("speed {}", rounded(speed))),
        angle("extension", request.gait.extension),
        angle("sidestep", request.gait.sidestep),
        request.velocity.map(velocity),
        request.destination.map(|destination| places_text(&destination)),
        request.intent.map(|intent| intent.text().to_owned()),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// Why a request was not granted as requested, with its place and with numbers where there are any.
fn objection_text(request: &Request, reply: &Reply) -> String {
    place_text(request, reply) + &problem_text(request, reply)
}

fn problem_text(request: &Request, reply: &Reply) -> String {
    if let (Reason::Outranked, Some(ControlAuthority { source, remaining })) = (reply.reason, reply.authority) {
        let requester = request.source;
        return format!(
            "`{source}` is in control and outranks `{requester}`; its authority expires in {remaining:.2} s"
        );
    }
    if let (Reason::Faulted | Reason::FaultPersists, Some(latched)) = (reply.reason, reply.latched) {
        return format!("{} ({latched})", reply.reason);
    }
    let Some(ActiveLimit { joint, value, limit }) = reply.active_limit else { return reply.reason.to_string() };
    let LimitUnit { per_si, name } = LimitUnit::of(reply.reason);
    // Some limits are bounds from below, and some are on one side or the other.
    let side = if value < limit { "at least" } else { "at most" };
    let [value, limit] = [value, limit].map(|number| (number * per_si * 1e3).round() / 1e3 + 0.0);
    let joint = joint.map(|joint| format!("joint {} ({}) ", joint.number(), joint.name())).unwrap_or_default();
    // The speed is a factor of time, which does not run backward.
    let is_backward = reply.reason == Reason::SpeedLimit && request.gait.speed.is_some_and(|speed| speed < 0.0);
    let hint = if is_backward { "; to walk backward, ask for a velocity vx below 0 instead" } else { "" };
    format!("{} ({joint}{value}{name}, must be {side} {limit}{name}){hint}", reply.reason)
}

/// The granted values of everything that was requested.
fn granted_text(request: &Request, reply: &Reply) -> String {
    let granted = &reply.granted;
    let angle = |name: &str, angle: f64| format!("{name} {}°", rounded(angle.to_degrees()));
    let parts = [
        request.gait.turn.map(|_| angle("turn", granted.turn)),
        request.gait.speed.map(|_| format!("speed {}", rounded(granted.speed))),
        request
            .gait
            .extension
            .map(|_| format!("{} (steps of {})", angle("extension", granted.extension), metres(reply.walk.step_ahead))),
        request
            .gait
            .sidestep
            .map(|_| format!("{} ({} aside)", angle("sidestep", granted.sidestep), metres(reply.walk.step_aside))),
        request.velocity.map(|_| velocity_text(reply)),
        request.destination.map(|destination| destination_text(&destination, request, reply)),
        request.intent.map(|intent| intent.text().to_owned()),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// A velocity, and by which steps it is walked.
fn velocity_text(reply: &Reply) -> String {
    let SteadyWalk { step_ahead, step_aside, velocity } = &reply.walk;
    // Rounded first, so that a small negative number is not printed as `-0.000`.
    let [ahead, left] = [velocity.ahead, velocity.left].map(|speed| (speed * 1e3).round() / 1e3 + 0.0);
    let turn = (velocity.turn.to_degrees() * 10.0).round() / 10.0 + 0.0;
    format!(
        "vx {ahead:.3} m/s, vy {left:.3} m/s, wz {turn:.1} °/s (speed {:.2}, steps of {}, {} aside)",
        reply.granted.speed,
        metres(*step_ahead),
        metres(*step_aside)
    )
}

/// A number rounded to a millionth.
fn to_micro(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

/// A number rounded such that the noise of its last binary digits and `-0` vanish.
fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9 + 0.0
}

#[cfg(test)]
mod tests {
    use expect_test::expect_file;
    use interface::{
        Command, Destination, Fault, GaitChange, Intent, LatchedFault, PlaceFrame, PlaceList, Places, Source, Waypoint,
    };
    use model::Joint;

    use super::*;

    fn reply(verdict: Verdict, reason: Reason) -> Reply {
        let granted = Command { turn: 10_f64.to_radians(), speed: 1.0, ..Command::NOMINAL };
        Reply { verdict, ..Reply::refused(reason, 12, granted, None) }
    }

    fn faster() -> Request {
        Request { gait: GaitChange { speed: Some(1.5), ..GaitChange::NONE }, ..Request::new(Source::Script) }
    }

    #[test]
    fn a_limit_is_named_with_joint_and_numbers() {
        let rate =
            ActiveLimit { joint: Some(Joint::RightKnee), value: 14.5_f64.to_radians(), limit: 12_f64.to_radians() };
        let limited = reply(Verdict::Limited, Reason::JointRate);
        let limited = Reply { active_limit: Some(rate), predicted_margin: Some(0.0214), ..limited };
        assert_eq!(
            reply_text(&faster(), &limited),
            "limited to speed 1, from half-step 12: a joint would exceed its rate limit (joint 5 (right_knee) \
             14.5 °/s, must be at most 12 °/s); predicted ZMP margin 21.4 mm"
        );
        let json = serde_json::to_value(ReplyJson::from(&limited)).unwrap();
        let bound = serde_json::json!({"joint": 5, "value": 14.5, "limit": 12.0, "unit": "°/s"});
        assert_eq!((&json["bound"], &json["predicted_margin_mm"]), (&bound, &21.4.into()));

        let active_limit = Some(ActiveLimit { joint: None, value: 9.0, limit: 1.4 });
        assert_eq!(
            reply_text(&faster(), &Reply { active_limit, ..reply(Verdict::Refused, Reason::SpeedLimit) }),
            "refused: the speed is outside the permitted range (9, must be at most 1.4)"
        );
    }

    /// A sole that the body turns must be held from turning by a moment of at least so much, and negative values have
    /// their limits on the other side.
    #[test]
    fn a_value_below_its_limit_must_be_at_least_that() {
        for (reason, value, limit, text) in [
            (Reason::YawTorque, 2.5, 4.0, "2.5 N·m, must be at least 4 N·m"),
            (Reason::YawTorque, -7.0, -6.0, "-7 N·m, must be at least -6 N·m"),
            (Reason::YawTorque, -2.0, -3.0, "-2 N·m, must be at most -3 N·m"),
            (Reason::Torque, -60.0, -50.0, "-60 N·m, must be at least -50 N·m"),
            (Reason::Torque, 60.0, 50.0, "60 N·m, must be at most 50 N·m"),
            (Reason::Margin, -0.002, 0.0, "-2 mm, must be at least 0 mm"),
            (Reason::SoleClearance, 0.01, 0.02, "10 mm, must be at least 20 mm"),
            (Reason::Friction, 0.8, 0.7, "0.8, must be at most 0.7"),
            (Reason::SpeedLimit, 0.3, 0.5, "0.3, must be at least 0.5"),
        ] {
            let active_limit = Some(ActiveLimit { joint: None, value, limit });
            let text = format!("refused: {reason} ({text})");
            assert_eq!(reply_text(&faster(), &Reply { active_limit, ..reply(Verdict::Refused, reason) }), text);
        }
    }

    #[test]
    fn the_source_in_control_is_named() {
        let authority = Some(ControlAuthority { source: Source::Teleop, remaining: 0.4201 });
        let refused = Reply { authority, ..reply(Verdict::Refused, Reason::Outranked) };
        assert_eq!(
            reply_text(&faster(), &refused),
            "refused: `teleop` is in control and outranks `script`; its authority expires in 0.42 s"
        );
        let json = serde_json::to_value(ReplyJson::from(&refused)).unwrap();
        assert_eq!(json["in_command"], serde_json::json!({"source": "teleop", "remaining_s": 0.4201}));
    }

    #[test]
    fn a_negative_speed_is_shown_the_way_backward() {
        let active_limit = Some(ActiveLimit { joint: None, value: -1.0, limit: 0.5 });
        let backward =
            Request { gait: GaitChange { speed: Some(-1.0), ..GaitChange::NONE }, ..Request::new(Source::Console) };
        assert_eq!(
            reply_text(&backward, &Reply { active_limit, ..reply(Verdict::Refused, Reason::SpeedLimit) }),
            "refused: the speed is outside the permitted range (-1, must be at least 0.5); to walk backward, ask for a \
             velocity vx below 0 instead"
        );
    }

    #[test]
    fn a_stream_that_stays_in_control_is_named() {
        let authority = Some(ControlAuthority { source: Source::Script, remaining: 0.3 });
        let granted = Reply { authority, ..reply(Verdict::Accepted, Reason::None) };
        let console = Request { source: Source::Console, ..faster() };
        assert_eq!(
            reply_text(&console, &granted),
            "accepted: speed 1, from half-step 12; the stream of `script` stays in control: the robot stops if it \
             falls silent"
        );
    }

    fn is_about_a_place(reason: Reason) -> bool {
        use Reason::{FeetCross, SameFoot, StepTooFar, StepTurn, TooFar};
        [FeetCross, SameFoot, StepTooFar, StepTurn, TooFar].contains(&reason)
    }

    /// Every reason with the numbers that replies of the controller have with it.
    #[test]
    fn every_reply_is_the_pinned_text() {
        let request = Request {
            gait: GaitChange { turn: Some(0.5), speed: Some(1.5), extension: Some(0.2), sidestep: Some(-0.1) },
            intent: Some(Intent::Walk),
            ..Request::new(Source::Script)
        };
        let mut text = String::new();
        for &reason in Reason::ALL {
            let active_limit = match reason {
                Reason::TurnLimit
                | Reason::SpeedLimit
                | Reason::ExtensionLimit
                | Reason::SidestepLimit
                | Reason::Margin
                | Reason::SoleClearance
                | Reason::LegReach
                | Reason::Friction
                | Reason::YawTorque
                | Reason::StepTooFar
                | Reason::FeetCross
                | Reason::StepTurn
                | Reason::TooFar => Some(ActiveLimit { joint: None, value: 0.5, limit: 0.4 }),
                Reason::JointRange | Reason::JointRate | Reason::Torque | Reason::Voltage => {
                    Some(ActiveLimit { joint: Some(Joint::LeftKnee), value: 0.5, limit: 0.4 })
                }
                _ => None,
            };
            let authority =
                (reason == Reason::Outranked).then_some(ControlAuthority { source: Source::Teleop, remaining: 0.42 });
            let verdict = match (reason, active_limit) {
                (Reason::None, _) => Verdict::Accepted,
                _ if is_about_a_place(reason) => Verdict::Refused,
                (_, Some(_)) => Verdict::Limited,
                _ => Verdict::Refused,
            };
            let predicted_margin = (verdict != Verdict::Refused).then_some(0.0214);
            let is_faulted = matches!(reason, Reason::Faulted | Reason::FaultPersists);
            let latched = is_faulted.then_some(LatchedFault { fault: Fault::MeasurementStale, time: 3.3, cause: None });
            let place = is_about_a_place(reason).then_some(7);
            let reply = Reply { active_limit, place, authority, predicted_margin, latched, ..reply(verdict, reason) };
            text += &format!("{reason:?}\n  {}\n", reply_text(&request, &reply));
            text += &format!("  {}\n", serde_json::to_string(&ReplyJson::from(&reply)).unwrap());
        }
        expect_file!["../tests/replies.txt"].assert_eq(&text);
    }

    #[test]
    fn a_reply_says_what_is_granted_why_and_from_when() {
        let turn = GaitChange { turn: Some(15_f64.to_radians()), ..GaitChange::NONE };
        let request = Request { gait: turn, ..Request::new(Source::Console) };
        assert_eq!(
            reply_text(&request, &reply(Verdict::Limited, Reason::TurnLimit)),
            "limited to turn 10°, from half-step 12: the turn is outside the permitted range"
        );
        assert_eq!(
            reply_text(&request, &reply(Verdict::Accepted, Reason::None)),
            "accepted: turn 10°, from half-step 12"
        );
        assert_eq!(
            reply_text(&request, &reply(Verdict::Refused, Reason::CannotRestart)),
            "refused: the uncompensated gait cannot restart from a stand: restart the controller"
        );
    }

    #[test]
    fn what_was_requested_is_told_as_it_is_typed() {
        let gait = GaitChange { turn: Some(15_f64.to_radians()), speed: Some(1.2), ..GaitChange::NONE };
        let walk = Request { gait, intent: Some(Intent::Walk), ..Request::new(Source::Script) };
        assert_eq!(request_text(&walk), "turn 15°, speed 1.2, walk");
        let velocity = Some(WalkVelocity { ahead: 0.3, left: -0.1, turn: 15_f64.to_radians() });
        let walks_at = Request { velocity, ..Request::new(Source::Script) };
        assert_eq!(request_text(&walks_at), "vx 0.3 m/s, vy -0.1 m/s, wz 15 °/s");
        let goal = Waypoint { x: 3.0, y: 2.0, heading: None };
        let places = PlaceList::new(&[goal]).map(Places::Waypoints).expect("a place");
        let destination = Some(Destination { frame: PlaceFrame::Walk, places });
        let goes = Request { destination, ..Request::new(Source::Script) };
        assert_eq!(request_text(&goes), "goal x 3.000 m, y 2.000 m");
    }

    #[test]
    fn a_velocity_that_is_nearly_zero_has_no_sign() {
        let velocity = WalkVelocity { ahead: 0.3, left: -4e-4, turn: -1e-4 };
        let request = Request { velocity: Some(velocity), ..Request::new(Source::Console) };
        let walk = SteadyWalk { velocity, ..SteadyWalk::ZERO };
        let text = reply_text(&request, &Reply { walk, ..reply(Verdict::Accepted, Reason::None) });
        assert!(text.starts_with("accepted: vx 0.300 m/s, vy 0.000 m/s, wz 0.0 °/s"), "{text}");
    }
}
