//! Push, anyone → simulated plant and back.

use iceoryx2::prelude::ZeroCopySend;
use interface::{PushReply, PushRequest};
use model::Joint;

use super::MessageFault;
use super::fault::Check;

/// A [`PushRequest`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.PushRequest.v1")]
#[repr(C)]
pub struct PushRequestMessage {
    /// Number of the joint that carries the pushed link, 1 to 20.
    pub link: u64,
    /// Force times duration (N·s): ahead, to the left and up, as the trunk faces when it begins.
    pub impulse: [f64; 3],
    /// How long it lasts (s).
    pub duration: f64,
}

/// A [`PushReply`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.PushReply.v1")]
#[repr(C)]
pub struct PushReplyMessage {
    /// A [`PushOutcome`](interface::PushOutcome).
    pub outcome: u64,
    /// When the push begins (s), since the plant's start.
    pub start: f64,
}

impl PushRequestMessage {
    /// The request, if its numbers are finite and its joint carries a body.
    pub fn checked(&self) -> Result<PushRequest, MessageFault> {
        let check = Check("push");
        let link = u8::try_from(self.link).ok().and_then(Joint::from_number);
        let link = link.filter(|joint| joint.link_name().is_some()).ok_or(MessageFault::UnknownCode {
            message: check.0,
            field: "link",
            value: u32::try_from(self.link).unwrap_or(u32::MAX),
            known: "the numbers of joints that carry a body",
        })?;
        Ok(PushRequest {
            link,
            impulse: check.numbers("impulse", &self.impulse)?.into(),
            duration: check.not_negative("duration", self.duration)?,
        })
    }
}

impl From<&PushRequest> for PushRequestMessage {
    fn from(push: &PushRequest) -> Self {
        Self { link: push.link.number().into(), impulse: push.impulse.into(), duration: push.duration }
    }
}

impl PushReplyMessage {
    /// The reply, if its code is known and its number finite.
    pub fn checked(&self) -> Result<PushReply, MessageFault> {
        let check = Check("push reply");
        let outcome = u32::try_from(self.outcome).unwrap_or(u32::MAX);
        Ok(PushReply { outcome: check.code("outcome", outcome)?, start: check.number("start", self.start)? })
    }
}

impl From<&PushReply> for PushReplyMessage {
    fn from(reply: &PushReply) -> Self {
        Self { outcome: reply.outcome.code().into(), start: reply.start }
    }
}

#[cfg(test)]
mod tests {
    use interface::PushOutcome;

    use super::*;

    #[test]
    fn a_push_survives_its_message() {
        let push = PushRequest { link: Joint::WaistRoll, impulse: [1.0, -2.0, 3.0].into(), duration: 0.1 };
        assert_eq!(PushRequestMessage::from(&push).checked(), Ok(push));
        let reply = PushReply { outcome: PushOutcome::TooMany, start: 1.5 };
        assert_eq!(PushReplyMessage::from(&reply).checked(), Ok(reply));
    }

    #[test]
    fn a_push_of_what_has_no_body_is_refused() {
        let push = PushRequestMessage { link: 16, impulse: [0.0; 3], duration: 0.1 };
        for link in [0, 1, 3, 21, 1 << 40] {
            assert!(PushRequestMessage { link, ..push }.checked().is_err(), "{link}");
        }
        assert!(PushRequestMessage { impulse: [0.0, f64::NAN, 0.0], ..push }.checked().is_err());
        assert!(PushRequestMessage { duration: -0.1, ..push }.checked().is_err());
    }
}
