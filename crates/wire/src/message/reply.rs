//! Reply, controller → operator: what became of a request, and why.

use iceoryx2::prelude::ZeroCopySend;
use interface::{
    ActiveLimit, Command, ControlAuthority, Intent, LatchedFault, Mode, PLACES_MAX, Rejection, Reply, Sensor,
    SteadyWalk, WalkVelocity,
};
use model::Joint;

use super::MessageFault;
use super::fault::Check;

/// A [`Reply`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Reply.v5")]
#[repr(C)]
pub struct ReplyMessage {
    /// The request's `id`.
    pub id: u64,
    /// A [`Verdict`](interface::Verdict).
    pub verdict: u32,
    /// A [`Reason`](interface::Reason).
    pub reason: u32,
    /// The half-step, counted from 0, at which it takes effect.
    pub effect_half_step: u64,
    /// `α` then (rad).
    pub turn: f64,
    /// `c` then.
    pub speed: f64,
    /// `β` then (rad).
    pub extension: f64,
    /// `γ` then (rad).
    pub sidestep: f64,
    /// How far ahead of the other foot each foot lands then (m).
    pub step_ahead: f64,
    /// How far a full step goes aside then (m), positive to the left.
    pub step_aside: f64,
    /// The mean velocity then: ahead, left (m/s), turning to the left (rad/s).
    pub velocity: [f64; 3],
    /// The [`Intent`] then, 0 if there is none.
    pub intent: u32,
    /// Which of the following are known: [`BOUND`](Self::BOUND) is `joint`, `value` and `limit`,
    /// [`IN_COMMAND`](Self::IN_COMMAND) is `source` and `remaining`, [`MARGIN`](Self::MARGIN) is `predicted_margin`,
    /// [`FAULT`](Self::FAULT) is `fault` and `fault_time`, [`MODE`](Self::MODE) is `mode`, [`CAUSE`](Self::CAUSE) is
    /// `cause` and `sensor`, [`ARRIVAL`](Self::ARRIVAL) is `arrival`.
    pub known: u32,
    /// The joint whose limit is active, by the paper's number, 1 to 20; 0 if it is no joint's.
    pub joint: u32,
    /// The [`Source`](interface::Source) in control, which outranks the request's.
    pub source: u32,
    /// What the request would have needed, in the unit of its reason.
    pub value: f64,
    /// What is permitted, in the same unit.
    pub limit: f64,
    /// Time until that source's authority expires if it sends nothing more (s).
    pub remaining: f64,
    /// Least predicted distance of the ZMP to the edge of the support polygon for what was granted (m).
    pub predicted_margin: f64,
    /// What the controller is doing: a [`Mode`](interface::Mode).
    pub mode: u32,
    /// The [`Fault`](interface::Fault) that is latched.
    pub fault: u32,
    /// When it was latched: time of the controller since its first tick (s).
    pub fault_time: f64,
    /// Why measurements were not used then: a [`Fault`](interface::Fault).
    pub cause: u32,
    /// The [`Sensor`](interface::Sensor) that it names.
    pub sensor: u32,
    /// The way-point or footstep that the reason is about, counted from 1; 0 if it is about none.
    pub place: u64,
    /// Foreseen time until the robot stands at its destination (s).
    pub arrival: f64,
}

impl ReplyMessage {
    /// In `known`: `joint`, `value` and `limit`.
    pub const BOUND: u32 = 1;
    /// In `known`: `source` and `remaining`.
    pub const IN_COMMAND: u32 = 2;
    /// In `known`: `predicted_margin`.
    pub const MARGIN: u32 = 4;
    /// In `known`: `fault` and `fault_time`.
    pub const FAULT: u32 = 8;
    /// In `known`: `mode`.
    pub const MODE: u32 = 16;
    /// In `known`: `cause` and `sensor`.
    pub const CAUSE: u32 = 32;
    /// In `known`: `arrival`.
    pub const ARRIVAL: u32 = 64;

    /// The reply, if its codes are known and every number that is known is finite.
    pub fn checked(&self) -> Result<Reply, MessageFault> {
        let check = Check("reply");
        const ALL: u32 = ReplyMessage::BOUND
            | ReplyMessage::IN_COMMAND
            | ReplyMessage::MARGIN
            | ReplyMessage::FAULT
            | ReplyMessage::MODE
            | ReplyMessage::CAUSE
            | ReplyMessage::ARRIVAL;
        let unknown = |field, value, known| MessageFault::UnknownCode { message: check.0, field, value, known };
        if self.known & !ALL != 0 {
            return Err(unknown(
                "known",
                self.known,
                "sums of 1 (bound), 2 (in command), 4 (margin), 8 (fault), 16 (mode), 32 (cause) and 64 (arrival)",
            ));
        }
        let knows = |bit| self.known & bit != 0;
        let joint = || match u8::try_from(self.joint).ok().map(|number| (number, Joint::from_number(number))) {
            Some((0, _)) => Ok(None),
            Some((_, Some(joint))) => Ok(Some(joint)),
            _ => Err(unknown("joint", self.joint, "0 (none) and 1 to 20")),
        };
        let place = || match u32::try_from(self.place).unwrap_or(u32::MAX) {
            0 => Ok(None),
            place if place as usize <= PLACES_MAX => Ok(Some(place)),
            place => Err(unknown("place", place, "0 (none) and 1 to 24")),
        };
        let active_limit = || {
            let (value, limit) = (check.number("value", self.value)?, check.number("limit", self.limit)?);
            Ok(ActiveLimit { joint: joint()?, value, limit })
        };
        let authority = || {
            let remaining = check.not_negative("remaining", self.remaining)?;
            Ok(ControlAuthority { source: check.code("source", self.source)?, remaining })
        };
        let margin = || check.number("predicted_margin", self.predicted_margin);
        let cause = || {
            let known = "256 × kind + number of the joint or foot";
            let sensor = Sensor::from_code(self.sensor).ok_or_else(|| unknown("sensor", self.sensor, known))?;
            Ok(Rejection { fault: check.code("cause", self.cause)?, sensor })
        };
        let latched = || {
            let time = check.number("fault_time", self.fault_time)?;
            let cause = if knows(Self::CAUSE) { Some(cause()?) } else { None };
            Ok(LatchedFault { fault: check.code("fault", self.fault)?, time, cause })
        };
        let mode = || check.code("mode", self.mode);
        Ok(Reply {
            id: self.id,
            verdict: check.code("verdict", self.verdict)?,
            reason: check.code("reason", self.reason)?,
            effect_half_step: self.effect_half_step,
            granted: Command {
                turn: check.number("turn", self.turn)?,
                speed: check.number("speed", self.speed)?,
                extension: check.number("extension", self.extension)?,
                sidestep: check.number("sidestep", self.sidestep)?,
            },
            walk: SteadyWalk {
                step_ahead: check.number("step_ahead", self.step_ahead)?,
                step_aside: check.number("step_aside", self.step_aside)?,
                velocity: {
                    let [ahead, left, turn] = check.numbers("velocity", &self.velocity)?;
                    WalkVelocity { ahead, left, turn }
                },
            },
            intent: if self.intent == 0 { None } else { Some(check.code("intent", self.intent)?) },
            active_limit: knows(Self::BOUND).then(active_limit).transpose()?,
            place: place()?,
            arrival: knows(Self::ARRIVAL).then(|| check.not_negative("arrival", self.arrival)).transpose()?,
            authority: knows(Self::IN_COMMAND).then(authority).transpose()?,
            predicted_margin: knows(Self::MARGIN).then(margin).transpose()?,
            mode: knows(Self::MODE).then(mode).transpose()?,
            latched: knows(Self::FAULT).then(latched).transpose()?,
        })
    }
}

impl From<&Reply> for ReplyMessage {
    fn from(reply: &Reply) -> Self {
        let Reply { active_limit, arrival, authority, predicted_margin, mode, latched, .. } = reply;
        let cause = latched.and_then(|latched| latched.cause);
        let bit = |present: bool, bit: u32| if present { bit } else { 0 };
        Self {
            id: reply.id,
            verdict: reply.verdict.code(),
            reason: reply.reason.code(),
            effect_half_step: reply.effect_half_step,
            turn: reply.granted.turn,
            speed: reply.granted.speed,
            extension: reply.granted.extension,
            sidestep: reply.granted.sidestep,
            step_ahead: reply.walk.step_ahead,
            step_aside: reply.walk.step_aside,
            velocity: [reply.walk.velocity.ahead, reply.walk.velocity.left, reply.walk.velocity.turn],
            intent: reply.intent.map_or(0, Intent::code),
            known: bit(active_limit.is_some(), Self::BOUND)
                | bit(authority.is_some(), Self::IN_COMMAND)
                | bit(predicted_margin.is_some(), Self::MARGIN)
                | bit(latched.is_some(), Self::FAULT)
                | bit(mode.is_some(), Self::MODE)
                | bit(cause.is_some(), Self::CAUSE)
                | bit(arrival.is_some(), Self::ARRIVAL),
            joint: active_limit.and_then(|limit| limit.joint).map_or(0, |joint| joint.number().into()),
            source: authority.map_or(0, |authority| authority.source.code()),
            value: active_limit.map_or(0.0, |limit| limit.value),
            limit: active_limit.map_or(0.0, |limit| limit.limit),
            remaining: authority.map_or(0.0, |authority| authority.remaining),
            predicted_margin: predicted_margin.unwrap_or(0.0),
            mode: mode.map_or(0, Mode::code),
            fault: latched.map_or(0, |latched| latched.fault.code()),
            fault_time: latched.map_or(0.0, |latched| latched.time),
            cause: cause.map_or(0, |cause| cause.fault.code()),
            sensor: cause.map_or(0, |cause| cause.sensor.code()),
            place: reply.place.map_or(0, u64::from),
            arrival: arrival.unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use interface::{Fault, Reason, Source, Verdict};

    use super::*;

    const GRANTED: Command = Command { turn: 0.2, speed: 1.1, extension: 0.0, sidestep: -0.1 };

    #[test]
    fn a_reply_survives_its_message() {
        let plain = Reply::refused(Reason::CannotRestart, 12, GRANTED, None);
        let rate = ActiveLimit { joint: Some(Joint::RightKnee), value: 14.0, limit: 12.0 };
        let authority = ControlAuthority { source: Source::Console, remaining: 0.25 };
        let cause = Some(Rejection { fault: Fault::JointOffSetpoint, sensor: Sensor::JointAngle(Joint::LeftKnee) });
        let latched = LatchedFault { fault: Fault::MeasurementStale, time: 3.3, cause };
        for reply in [
            plain,
            Reply { intent: Some(Intent::Hold), ..plain },
            Reply { verdict: Verdict::Accepted, reason: Reason::None, predicted_margin: Some(-0.01), ..plain },
            Reply { verdict: Verdict::Limited, reason: Reason::JointRate, active_limit: Some(rate), ..plain },
            Reply { reason: Reason::Margin, active_limit: Some(ActiveLimit { joint: None, ..rate }), ..plain },
            Reply { reason: Reason::Outranked, authority: Some(authority), ..plain },
            Reply { reason: Reason::FeetCross, active_limit: Some(rate), place: Some(24), ..plain },
            Reply { verdict: Verdict::Accepted, reason: Reason::None, arrival: Some(12.5), ..plain },
            Reply { id: 9, reason: Reason::Faulted, mode: Some(Mode::Faulted), latched: Some(latched), ..plain },
        ] {
            assert_eq!(ReplyMessage::from(&reply).checked(), Ok(reply));
        }
    }

    #[test]
    fn unknown_fields_are_ignored_and_known_ones_checked() {
        let refused = Reply::refused(Reason::CannotRestart, 12, GRANTED, None);
        let active_limit = Some(ActiveLimit { joint: None, value: 2.0, limit: 1.0 });
        let authority = Some(ControlAuthority { source: Source::Teleop, remaining: 0.1 });
        let predicted_margin = Some(0.02);
        let full = ReplyMessage::from(&Reply { active_limit, authority, predicted_margin, ..refused });
        let nonsense = ReplyMessage { joint: 99, source: 99, value: f64::NAN, remaining: -1.0, ..full };
        assert_eq!(ReplyMessage { known: 0, ..nonsense }.checked(), Ok(refused));

        let text = |message: ReplyMessage| message.checked().unwrap_err().to_string();
        assert_eq!(text(ReplyMessage { value: f64::NAN, ..full }), "reply: value is NaN; it must be finite");
        assert_eq!(text(ReplyMessage { joint: 21, ..full }), "reply: joint is 21; known are 0 (none) and 1 to 20");
        assert_eq!(text(ReplyMessage { joint: 257, ..full }), "reply: joint is 257; known are 0 (none) and 1 to 20");
        assert_eq!(text(ReplyMessage { place: 25, ..full }), "reply: place is 25; known are 0 (none) and 1 to 24");
        let late = ReplyMessage { known: ReplyMessage::ARRIVAL, arrival: f64::NAN, ..full };
        assert_eq!(text(late), "reply: arrival is NaN; it must be finite");
        assert!(text(ReplyMessage { source: 9, ..full }).starts_with("reply: source is 9; known are 0 (console)"));
        assert_eq!(text(ReplyMessage { remaining: -1.0, ..full }), "reply: remaining is -1; it must be at least 0");
        assert!(text(ReplyMessage { predicted_margin: f64::INFINITY, ..full }).starts_with("reply: predicted_margin"));
        assert!(
            text(ReplyMessage { known: 128, ..full }).starts_with("reply: known is 128; known are sums of 1 (bound)")
        );
    }

    #[test]
    fn zeroed_memory_is_not_a_reply() {
        let zero = ReplyMessage {
            id: 0,
            verdict: 0,
            reason: 0,
            effect_half_step: 0,
            turn: 0.0,
            speed: 0.0,
            extension: 0.0,
            sidestep: 0.0,
            step_ahead: 0.0,
            step_aside: 0.0,
            velocity: [0.0; 3],
            intent: 0,
            known: 0,
            joint: 0,
            source: 0,
            value: 0.0,
            limit: 0.0,
            remaining: 0.0,
            predicted_margin: 0.0,
            mode: 0,
            fault: 0,
            fault_time: 0.0,
            cause: 0,
            sensor: 0,
            place: 0,
            arrival: 0.0,
        };
        assert!(zero.checked().unwrap_err().to_string().starts_with("reply: verdict is 0; known are 1 (accepted)"));
    }
}
