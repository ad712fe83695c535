//! Request, operator → controller: what the walk shall be from now on.

use iceoryx2::prelude::ZeroCopySend;

use super::MessageFault;
use super::code::codes;
use super::fault::Check;

codes! {
    /// What the robot shall do.
    Intent {
        /// Start walking, or go on.
        Walk = 1 "walk",
        /// Come to a stand at the end of a half-step.
        Stop = 2 "stop",
        /// Keep the present posture.
        Hold = 3 "hold",
        /// Take back a latched fault.
        Reset = 4 "reset",
        /// Step without getting ahead, turning if a turn is asked.
        InPlace = 5 "in-place",
    }
}

codes! {
    /// Who asks.
    Source {
        /// A person at a command line.
        Console = 0 "console",
        /// A file or a pipe.
        Script = 1 "script",
        /// A person with keys under the fingers.
        Teleop = 2 "teleop",
        /// Another program.
        Program = 3 "program",
    }
}

codes! {
    /// How long what is asked lasts.
    Lasting {
        /// Until another request changes it: a single request.
        UntilChanged = 0 "until changed",
        /// Only while its source goes on speaking: a request of a stream. When the source has been silent for longer than
        /// the age limit, the walk comes to a stand. A request for nothing is a sign of life.
        WhileSpeaking = 1 "while its source speaks",
        /// From now on until changed, as all that this source asked for: the end of a stream. May ask for nothing.
        Farewell = 2 "after its source has left",
    }
}

/// A [`Request`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Request.v2")]
#[repr(C)]
pub struct RequestMessage {
    /// The controller's tick before which it must not take effect; 0 is at once.
    pub not_before: u64,
    /// Which of the following are asked for: [`TURN`](Self::TURN), [`SPEED`](Self::SPEED),
    /// [`EXTENSION`](Self::EXTENSION), [`INTENT`](Self::INTENT). What is not stays as it is.
    pub present: u32,
    /// An [`Intent`].
    pub intent: u32,
    /// A [`Source`].
    pub source: u32,
    /// A [`Lasting`].
    pub lasting: u32,
    /// `α`: turn per full step [rad], positive to the left.
    pub turn: f64,
    /// `c`: 1 is the nominal speed.
    pub speed: f64,
    /// `β`: step extension [rad].
    pub extension: f64,
    /// How long the source may be silent [s], 0 for the controller's own limit. Counts only while the source speaks.
    pub age_limit: f64,
}

/// A change of the walk; what is `None` stays as it is. The set is atomic: it takes effect whole or not at all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// The controller's tick before which it must not take effect; 0 is at once.
    pub not_before: u64,
    /// Who asks.
    pub source: Source,
    /// What the robot shall do.
    pub intent: Option<Intent>,
    /// `α`: turn per full step [rad], positive to the left.
    pub turn: Option<f64>,
    /// `c`: 1 is the nominal speed.
    pub speed: Option<f64>,
    /// `β`: step extension [rad].
    pub extension: Option<f64>,
    /// How long what is asked lasts.
    pub lasting: Lasting,
    /// How long the source may be silent [s]; `None` is the controller's own limit. Counts only while the source speaks.
    pub age_limit: Option<f64>,
}

impl Request {
    /// A request for nothing that lasts until changed, to be filled in.
    pub fn by(source: Source) -> Self {
        Self {
            not_before: 0,
            source,
            intent: None,
            turn: None,
            speed: None,
            extension: None,
            lasting: Lasting::UntilChanged,
            age_limit: None,
        }
    }
}

impl RequestMessage {
    /// In `present`: `turn` is asked for.
    pub const TURN: u32 = 1;
    /// In `present`: `speed` is asked for.
    pub const SPEED: u32 = 2;
    /// In `present`: `extension` is asked for.
    pub const EXTENSION: u32 = 4;
    /// In `present`: `intent` is asked for.
    pub const INTENT: u32 = 8;

    /// The request, if its codes are known, every number that is present is finite, and the age limit is not negative.
    pub fn checked(&self) -> Result<Request, MessageFault> {
        let check = Check("request");
        const ALL: u32 =
            RequestMessage::TURN | RequestMessage::SPEED | RequestMessage::EXTENSION | RequestMessage::INTENT;
        if self.present & !ALL != 0 {
            let (field, known) = ("present", "sums of 1 (turn), 2 (speed), 4 (extension) and 8 (intent)");
            return Err(MessageFault::UnknownCode { message: check.0, field, value: self.present, known });
        }
        let number = |bit, field, value| {
            if self.present & bit != 0 { check.number(field, value).map(Some) } else { Ok(None) }
        };
        let lasting = check.code("lasting", self.lasting)?;
        let age_limit = match lasting {
            Lasting::WhileSpeaking => Some(check.not_negative("age_limit", self.age_limit)?),
            Lasting::UntilChanged | Lasting::Farewell => None,
        };
        Ok(Request {
            not_before: self.not_before,
            source: check.code("source", self.source)?,
            intent: if self.present & Self::INTENT != 0 { Some(check.code("intent", self.intent)?) } else { None },
            turn: number(Self::TURN, "turn", self.turn)?,
            speed: number(Self::SPEED, "speed", self.speed)?,
            extension: number(Self::EXTENSION, "extension", self.extension)?,
            lasting,
            age_limit: age_limit.filter(|&limit| limit > 0.0),
        })
    }
}

impl From<&Request> for RequestMessage {
    fn from(request: &Request) -> Self {
        let bit = |present: bool, bit: u32| if present { bit } else { 0 };
        Self {
            not_before: request.not_before,
            present: bit(request.turn.is_some(), Self::TURN)
                | bit(request.speed.is_some(), Self::SPEED)
                | bit(request.extension.is_some(), Self::EXTENSION)
                | bit(request.intent.is_some(), Self::INTENT),
            intent: request.intent.map_or(0, Intent::code),
            source: request.source.code(),
            lasting: request.lasting.code(),
            turn: request.turn.unwrap_or(0.0),
            speed: request.speed.unwrap_or(0.0),
            extension: request.extension.unwrap_or(0.0),
            age_limit: request.age_limit.unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_absent_may_be_anything() {
        let request = Request { turn: Some(0.1), intent: Some(Intent::Walk), ..Request::by(Source::Console) };
        let mut message = RequestMessage::from(&request);
        message.speed = f64::NAN;
        assert_eq!(message.checked(), Ok(request));
    }

    #[test]
    fn a_streams_age_limit_arrives_and_no_others() {
        for (lasting, age_limit, arrives) in [
            (Lasting::WhileSpeaking, Some(0.3), Some(0.3)),
            (Lasting::WhileSpeaking, None, None),
            (Lasting::UntilChanged, Some(0.3), None),
            (Lasting::Farewell, Some(0.3), None),
        ] {
            let request = Request { lasting, age_limit, ..Request::by(Source::Teleop) };
            let checked = RequestMessage::from(&request).checked();
            assert_eq!(checked, Ok(Request { age_limit: arrives, ..request }));
        }
    }

    #[test]
    fn what_is_present_must_make_sense() {
        let good = RequestMessage::from(&Request {
            intent: Some(Intent::Stop),
            speed: Some(1.2),
            ..Request::by(Source::Script)
        });
        let text = |message: RequestMessage| message.checked().unwrap_err().to_string();
        assert_eq!(text(RequestMessage { speed: f64::NAN, ..good }), "request: speed is NaN; it must be finite");
        assert!(text(RequestMessage { intent: 9, ..good }).starts_with("request: intent is 9; known are 1 (walk)"));
        assert!(
            text(RequestMessage { source: 77, ..good }).starts_with("request: source is 77; known are 0 (console)")
        );
        assert!(text(RequestMessage { lasting: 3, ..good }).starts_with("request: lasting is 3; known are 0 (until"));
        let stream = RequestMessage { lasting: Lasting::WhileSpeaking.code(), ..good };
        let aged = |age_limit| text(RequestMessage { age_limit, ..stream });
        assert_eq!(aged(-1.0), "request: age_limit is -1; it must be at least 0");
        assert_eq!(aged(f64::INFINITY), "request: age_limit is inf; it must be finite");
        assert!(text(RequestMessage { present: 16, ..good }).starts_with("request: present is 16; known are sums"));
    }
}
