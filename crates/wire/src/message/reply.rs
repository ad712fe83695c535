//! Reply, controller → operator: what became of a request, and why.

use iceoryx2::prelude::ZeroCopySend;

use super::code::codes;
use super::fault::Check;
use super::{Intent, MessageFault};

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
    }
}

/// A [`Reply`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Reply.v1")]
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
    /// Always 0.
    pub pad: u32,
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

impl ReplyMessage {
    /// The reply, if its codes are known and its numbers finite.
    pub fn checked(&self) -> Result<Reply, MessageFault> {
        let check = Check("reply");
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
        })
    }
}

impl From<&Reply> for ReplyMessage {
    fn from(reply: &Reply) -> Self {
        Self {
            verdict: reply.verdict.code(),
            reason: reply.reason.code(),
            effect_half_step: reply.effect_half_step,
            turn: reply.granted.turn,
            speed: reply.granted.speed,
            extension: reply.granted.extension,
            intent: reply.granted.intent.map_or(0, Intent::code),
            pad: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_survives_the_way_there_and_back() {
        for intent in [None, Some(Intent::Hold)] {
            let granted = Granted { turn: 0.2, speed: 1.1, extension: 0.0, intent };
            let reply = Reply { verdict: Verdict::Limited, reason: Reason::TurnLimit, effect_half_step: 12, granted };
            assert_eq!(ReplyMessage::from(&reply).checked(), Ok(reply));
        }
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
            pad: 0,
        };
        assert!(zero.checked().unwrap_err().to_string().starts_with("reply: verdict is 0; known are 1 (accepted)"));
    }
}
