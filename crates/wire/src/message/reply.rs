//! Reply, controller → operator: what became of a request, and why.

use iceoryx2::prelude::ZeroCopySend;
use model::Joint;

use super::code::codes;
use super::fault::Check;
use super::{Intent, MessageFault, Source};

codes! {
    /// What became of a request.
    Verdict {
        /// It takes effect as asked.
        Accepted = 1 "accepted",
        /// It takes effect, held within a limit: see what was granted.
        Limited = 2 "limited",
        /// Nothing of it takes effect.
        Refused = 3 "refused",
    }
}

codes! {
    /// Why a request was limited or refused.
    Reason {
        /// It was not.
        None = 0 "no objection",
        /// The turn is beyond what the walk can do.
        TurnLimit = 1 "the turn is larger than this walk can do",
        /// The speed is beyond what the walk can do.
        SpeedLimit = 2 "the speed is outside what this walk can do",
        /// The extension is beyond what the walk can do.
        ExtensionLimit = 3 "the step extension is larger than this walk can do",
        /// A number is NaN or infinite.
        NotFinite = 4 "a number is not finite",
        /// The robot lies, or stands without a plan for going on.
        NoWayBack = 5 "this walk cannot go on any more: start a new one",
        /// Too many requests wait for their tick.
        QueueFull = 6 "too many requests are waiting for their tick",
        /// A code means nothing to this controller.
        NotUnderstood = 7 "a code in the request means nothing to this controller",
        /// The request asks for nothing.
        Empty = 8 "the request asks for nothing",
        /// The controller is going away.
        ShuttingDown = 9 "the controller is shutting down",
        /// A source that goes before this one is in command: see [`Reply::in_command`].
        Outranked = 10 "a source that goes before this one is in command",
        /// The predicted margin would be too small: see [`Reply::bound`] [m].
        Margin = 11 "the zero-moment point would come too near to the edge of the sole",
        /// A joint would leave its range: see [`Reply::bound`] [rad].
        JointRange = 12 "a joint would leave its range",
        /// A joint would move too fast: see [`Reply::bound`] [rad/s].
        JointRate = 13 "a joint would move too fast",
        /// A motor would need more torque than it has: see [`Reply::bound`] [N·m].
        Torque = 14 "a motor would need more torque than it has",
        /// A motor would need more voltage than there is: see [`Reply::bound`] [V].
        Voltage = 15 "a motor would need more voltage than there is",
        /// The swinging sole would come too near to the ground: see [`Reply::bound`] [m].
        SoleClearance = 16 "the swinging sole would come too near to the ground",
        /// A leg would have to be longer than it is: see [`Reply::bound`] [m].
        LegReach = 17 "a leg would have to reach too far",
        /// A newer request took its place before it could take effect.
        Superseded = 18 "a newer request took its place",
        /// The robot has fallen.
        Fallen = 19 "the robot has fallen: put it on its feet and ask for a reset",
        /// A fault is latched.
        Faulted = 20 "a fault is latched: ask for a reset",
        /// What went wrong still is.
        NotWell = 21 "what went wrong still is: the robot must be on its feet and be heard from",
    }
}

/// A [`Reply`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Reply.v2")]
#[repr(C)]
pub struct ReplyMessage {
    /// A [`Verdict`].
    pub verdict: u32,
    /// A [`Reason`].
    pub reason: u32,
    /// The half-step, counted from 0, at which it takes effect.
    pub effect_half_step: u64,
    /// `α` then [rad].
    pub turn: f64,
    /// `c` then.
    pub speed: f64,
    /// `β` then [rad].
    pub extension: f64,
    /// The [`Intent`] then, 0 if there is none.
    pub intent: u32,
    /// Which of the following are known: [`BOUND`](Self::BOUND) is `joint`, `value` and `limit`,
    /// [`IN_COMMAND`](Self::IN_COMMAND) is `source` and `remaining`, [`MARGIN`](Self::MARGIN) is `predicted_margin`.
    pub known: u32,
    /// Whose limit bound, by the paper's number, 1 to 20; 0 if it is no joint's.
    pub joint: u32,
    /// The [`Source`] in command that outranks the one that asked.
    pub source: u32,
    /// What the request would have needed, in the unit of its reason.
    pub value: f64,
    /// What may be, in the same unit.
    pub limit: f64,
    /// How long the source in command holds if it says no more [s].
    pub remaining: f64,
    /// Least distance of the zero-moment point to the edge of what bears that is predicted for what was granted [m].
    pub predicted_margin: f64,
}

/// What became of a request, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// Accepted, limited or refused.
    pub verdict: Verdict,
    /// Why, if it was not simply accepted.
    pub reason: Reason,
    /// The half-step, counted from 0, at which it takes effect.
    pub effect_half_step: u64,
    /// What holds from then on; after a refusal, what holds already.
    pub granted: Granted,
    /// The limit that bound, in numbers, if the reason is a limit.
    pub bound: Option<Bound>,
    /// Who is in command, if the reason is that.
    pub in_command: Option<InCommand>,
    /// Least distance of the zero-moment point to the edge of what bears that is predicted for what was granted [m];
    /// negative outside. `None` if nothing was predicted.
    pub predicted_margin: Option<f64>,
}

/// A limit that bound, and what it kept away. Both numbers are in the unit of the [`Reason`]: turn, extension and joint
/// range [rad], joint rate [rad/s], torque [N·m], voltage [V], margin, clearance and reach [m], speed as a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The physical joint, if it is a joint's limit.
    pub joint: Option<Joint>,
    /// What the request as asked would have needed.
    pub value: f64,
    /// What may be.
    pub limit: f64,
}

/// Who holds command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InCommand {
    /// The source.
    pub source: Source,
    /// For how long, if it says no more [s].
    pub remaining: f64,
}

/// The whole request in force, with what was not asked for filled in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Granted {
    /// `α`: turn per full step [rad], positive to the left.
    pub turn: f64,
    /// `c`: 1 is the nominal speed.
    pub speed: f64,
    /// `β`: step extension [rad].
    pub extension: f64,
    /// What the robot shall do, if it was told.
    pub intent: Option<Intent>,
}

impl Reply {
    /// A refusal; `granted` is what holds all the same.
    pub fn refused(reason: Reason, effect_half_step: u64, granted: Granted) -> Self {
        Self {
            verdict: Verdict::Refused,
            reason,
            effect_half_step,
            granted,
            bound: None,
            in_command: None,
            predicted_margin: None,
        }
    }
}

impl ReplyMessage {
    /// In `known`: `joint`, `value` and `limit`.
    pub const BOUND: u32 = 1;
    /// In `known`: `source` and `remaining`.
    pub const IN_COMMAND: u32 = 2;
    /// In `known`: `predicted_margin`.
    pub const MARGIN: u32 = 4;

    /// The reply, if its codes are known and every number that is known is finite.
    pub fn checked(&self) -> Result<Reply, MessageFault> {
        let check = Check("reply");
        const ALL: u32 = ReplyMessage::BOUND | ReplyMessage::IN_COMMAND | ReplyMessage::MARGIN;
        let unknown = |field, value, known| MessageFault::UnknownCode { message: check.0, field, value, known };
        if self.known & !ALL != 0 {
            return Err(unknown("known", self.known, "sums of 1 (bound), 2 (in command) and 4 (margin)"));
        }
        let knows = |bit| self.known & bit != 0;
        let joint = || match u8::try_from(self.joint).ok().map(|number| (number, Joint::from_number(number))) {
            Some((0, _)) => Ok(None),
            Some((_, Some(joint))) => Ok(Some(joint)),
            _ => Err(unknown("joint", self.joint, "0 (none) and 1 to 20")),
        };
        let bound = || {
            let (value, limit) = (check.number("value", self.value)?, check.number("limit", self.limit)?);
            Ok(Bound { joint: joint()?, value, limit })
        };
        let in_command = || {
            let remaining = check.not_negative("remaining", self.remaining)?;
            Ok(InCommand { source: check.code("source", self.source)?, remaining })
        };
        let margin = || check.number("predicted_margin", self.predicted_margin);
        Ok(Reply {
            verdict: check.code("verdict", self.verdict)?,
            reason: check.code("reason", self.reason)?,
            effect_half_step: self.effect_half_step,
            granted: Granted {
                turn: check.number("turn", self.turn)?,
                speed: check.number("speed", self.speed)?,
                extension: check.number("extension", self.extension)?,
                intent: if self.intent == 0 { None } else { Some(check.code("intent", self.intent)?) },
            },
            bound: knows(Self::BOUND).then(bound).transpose()?,
            in_command: knows(Self::IN_COMMAND).then(in_command).transpose()?,
            predicted_margin: knows(Self::MARGIN).then(margin).transpose()?,
        })
    }
}

impl From<&Reply> for ReplyMessage {
    fn from(reply: &Reply) -> Self {
        let Reply { bound, in_command, predicted_margin, .. } = reply;
        let bit = |present: bool, bit: u32| if present { bit } else { 0 };
        Self {
            verdict: reply.verdict.code(),
            reason: reply.reason.code(),
            effect_half_step: reply.effect_half_step,
            turn: reply.granted.turn,
            speed: reply.granted.speed,
            extension: reply.granted.extension,
            intent: reply.granted.intent.map_or(0, Intent::code),
            known: bit(bound.is_some(), Self::BOUND)
                | bit(in_command.is_some(), Self::IN_COMMAND)
                | bit(predicted_margin.is_some(), Self::MARGIN),
            joint: bound.and_then(|bound| bound.joint).map_or(0, |joint| joint.number().into()),
            source: in_command.map_or(0, |in_command| in_command.source.code()),
            value: bound.map_or(0.0, |bound| bound.value),
            limit: bound.map_or(0.0, |bound| bound.limit),
            remaining: in_command.map_or(0.0, |in_command| in_command.remaining),
            predicted_margin: predicted_margin.unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRANTED: Granted = Granted { turn: 0.2, speed: 1.1, extension: 0.0, intent: None };

    #[test]
    fn it_survives_the_way_there_and_back() {
        let plain = Reply::refused(Reason::NoWayBack, 12, GRANTED);
        let rate = Bound { joint: Some(Joint::RightKnee), value: 14.0, limit: 12.0 };
        let in_command = InCommand { source: Source::Console, remaining: 0.25 };
        for reply in [
            plain,
            Reply { granted: Granted { intent: Some(Intent::Hold), ..GRANTED }, ..plain },
            Reply { verdict: Verdict::Accepted, reason: Reason::None, predicted_margin: Some(-0.01), ..plain },
            Reply { verdict: Verdict::Limited, reason: Reason::JointRate, bound: Some(rate), ..plain },
            Reply { reason: Reason::Margin, bound: Some(Bound { joint: None, ..rate }), ..plain },
            Reply { reason: Reason::Outranked, in_command: Some(in_command), ..plain },
        ] {
            assert_eq!(ReplyMessage::from(&reply).checked(), Ok(reply));
        }
    }

    #[test]
    fn what_is_not_known_may_be_anything_and_what_is_must_make_sense() {
        let refused = Reply::refused(Reason::NoWayBack, 12, GRANTED);
        let bound = Some(Bound { joint: None, value: 2.0, limit: 1.0 });
        let in_command = Some(InCommand { source: Source::Teleop, remaining: 0.1 });
        let predicted_margin = Some(0.02);
        let full = ReplyMessage::from(&Reply { bound, in_command, predicted_margin, ..refused });
        let nonsense = ReplyMessage { joint: 99, source: 99, value: f64::NAN, remaining: -1.0, ..full };
        assert_eq!(ReplyMessage { known: 0, ..nonsense }.checked(), Ok(refused));

        let text = |message: ReplyMessage| message.checked().unwrap_err().to_string();
        assert_eq!(text(ReplyMessage { value: f64::NAN, ..full }), "reply: value is NaN; it must be finite");
        assert_eq!(text(ReplyMessage { joint: 21, ..full }), "reply: joint is 21; known are 0 (none) and 1 to 20");
        assert_eq!(text(ReplyMessage { joint: 257, ..full }), "reply: joint is 257; known are 0 (none) and 1 to 20");
        assert!(text(ReplyMessage { source: 4, ..full }).starts_with("reply: source is 4; known are 0 (console)"));
        assert_eq!(text(ReplyMessage { remaining: -1.0, ..full }), "reply: remaining is -1; it must be at least 0");
        assert!(text(ReplyMessage { predicted_margin: f64::INFINITY, ..full }).starts_with("reply: predicted_margin"));
        assert!(text(ReplyMessage { known: 8, ..full }).starts_with("reply: known is 8; known are sums of 1 (bound)"));
    }

    #[test]
    fn an_empty_memory_is_no_reply() {
        let zero = ReplyMessage {
            verdict: 0,
            reason: 0,
            effect_half_step: 0,
            turn: 0.0,
            speed: 0.0,
            extension: 0.0,
            intent: 0,
            known: 0,
            joint: 0,
            source: 0,
            value: 0.0,
            limit: 0.0,
            remaining: 0.0,
            predicted_margin: 0.0,
        };
        assert!(zero.checked().unwrap_err().to_string().starts_with("reply: verdict is 0; known are 1 (accepted)"));
    }
}
