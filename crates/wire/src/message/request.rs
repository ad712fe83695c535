//! Request, operator → controller: a change of the walk.

use iceoryx2::prelude::ZeroCopySend;
use interface::{GaitChange, Intent, Lifetime, Request, WalkVelocity};

use super::MessageFault;
use super::fault::Check;
use super::flat_places::FlatPlaces;

/// A [`Request`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Request.v5")]
#[repr(C)]
pub struct RequestMessage {
    /// The controller's tick before which it must not take effect; 0 is at once.
    pub not_before: u64,
    /// Which of the following are asked for: [`TURN`](Self::TURN), [`SPEED`](Self::SPEED),
    /// [`EXTENSION`](Self::EXTENSION), [`INTENT`](Self::INTENT), [`SIDESTEP`](Self::SIDESTEP),
    /// [`VELOCITY`](Self::VELOCITY), [`DESTINATION`](Self::DESTINATION); what is not stays as it is. And
    /// [`MORE`](Self::MORE).
    pub present: u32,
    /// An [`Intent`].
    pub intent: u32,
    /// A [`Source`](interface::Source).
    pub source: u32,
    /// A [`Lifetime`].
    pub lasting: u32,
    /// `α`: turn per full step (rad), positive to the left.
    pub turn: f64,
    /// `c`: 1 is the nominal speed.
    pub speed: f64,
    /// `β`: step extension (rad).
    pub extension: f64,
    /// `γ`: sidestep per full step (rad), positive to the left.
    pub sidestep: f64,
    /// The velocity to walk at: ahead, left (m/s), turning to the left (rad/s).
    pub velocity: [f64; 3],
    /// The places of the destination: x, y (m), heading (rad) of each.
    pub places: [f64; 72],
    /// How many places there are, 1 to [`PLACES_MAX`](interface::PLACES_MAX); the others are ignored.
    pub place_count: u32,
    /// What the places are: 0 way-points, 1 footsteps.
    pub place_kind: u32,
    /// The frame of the places: 0 the walk frame, 1 the robot's own.
    pub place_frame: u32,
    /// A bit for each place, the first one's is 1: of a way-point, whether its heading is given; of a footstep, whether
    /// it is the left foot's.
    pub place_marks: u32,
    /// Command timeout of a streamed request (s), 0 for the controller's own.
    pub age_limit: f64,
    /// A number of the sender's choice, which the reply repeats.
    pub id: u64,
    /// When it expires, by `CLOCK_MONOTONIC` (ns); 0 is never.
    pub expires_ns: u64,
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
    /// In `present`: another request of the same script follows, which takes effect no earlier. A controller in
    /// lockstep waits for it, so that the walk does not depend on when it is sent.
    pub const MORE: u32 = 16;
    /// In `present`: `sidestep` is asked for.
    pub const SIDESTEP: u32 = 32;
    /// In `present`: `velocity` is asked for, instead of gait parameters.
    pub const VELOCITY: u32 = 64;
    /// In `present`: the places are the destination.
    pub const DESTINATION: u32 = 128;

    /// The request, if its codes are known, every number that is present is finite, and the age limit is not negative.
    pub fn checked(&self) -> Result<Request, MessageFault> {
        let check = Check("request");
        const ALL: u32 = RequestMessage::TURN
            | RequestMessage::SPEED
            | RequestMessage::EXTENSION
            | RequestMessage::INTENT
            | RequestMessage::MORE
            | RequestMessage::SIDESTEP
            | RequestMessage::VELOCITY
            | RequestMessage::DESTINATION;
        if self.present & !ALL != 0 {
            let known = "sums of 1 (turn), 2 (speed), 4 (extension), 8 (intent), 16 (more), 32 (sidestep), 64 \
                         (velocity) and 128 (destination)";
            let field = "present";
            return Err(MessageFault::UnknownCode { message: check.0, field, value: self.present, known });
        }
        let number = |bit, field, value| {
            if self.present & bit != 0 { check.number(field, value).map(Some) } else { Ok(None) }
        };
        let lifetime = check.code("lasting", self.lasting)?;
        let timeout = match lifetime {
            Lifetime::Streamed => Some(check.not_negative("age_limit", self.age_limit)?),
            Lifetime::Latched | Lifetime::Release => None,
        };
        Ok(Request {
            not_before: self.not_before,
            source: check.code("source", self.source)?,
            intent: if self.present & Self::INTENT != 0 { Some(check.code("intent", self.intent)?) } else { None },
            gait: GaitChange {
                turn: number(Self::TURN, "turn", self.turn)?,
                speed: number(Self::SPEED, "speed", self.speed)?,
                extension: number(Self::EXTENSION, "extension", self.extension)?,
                sidestep: number(Self::SIDESTEP, "sidestep", self.sidestep)?,
            },
            velocity: if self.present & Self::VELOCITY != 0 {
                let [ahead, left, turn] = check.numbers("velocity", &self.velocity)?;
                Some(WalkVelocity { ahead, left, turn })
            } else {
                None
            },
            destination: if self.present & Self::DESTINATION != 0 {
                Some(self.flat_places().checked(&check)?)
            } else {
                None
            },
            lifetime,
            timeout: timeout.filter(|&timeout| timeout > 0.0),
            id: self.id,
            expires_ns: (self.expires_ns != 0).then_some(self.expires_ns),
        })
    }

    fn flat_places(&self) -> FlatPlaces {
        let Self { places, place_count: count, place_kind: kind, place_frame: frame, place_marks: marks, .. } = *self;
        FlatPlaces { places, count, kind, frame, marks }
    }
}

impl From<&Request> for RequestMessage {
    fn from(request: &Request) -> Self {
        let bit = |present: bool, bit: u32| if present { bit } else { 0 };
        let GaitChange { turn, speed, extension, sidestep } = request.gait;
        let FlatPlaces { places, count, kind, frame, marks } =
            request.destination.as_ref().map_or(FlatPlaces::NONE, Into::into);
        Self {
            not_before: request.not_before,
            present: bit(turn.is_some(), Self::TURN)
                | bit(speed.is_some(), Self::SPEED)
                | bit(extension.is_some(), Self::EXTENSION)
                | bit(sidestep.is_some(), Self::SIDESTEP)
                | bit(request.velocity.is_some(), Self::VELOCITY)
                | bit(request.destination.is_some(), Self::DESTINATION)
                | bit(request.intent.is_some(), Self::INTENT),
            intent: request.intent.map_or(0, Intent::code),
            source: request.source.code(),
            lasting: request.lifetime.code(),
            turn: turn.unwrap_or(0.0),
            speed: speed.unwrap_or(0.0),
            extension: extension.unwrap_or(0.0),
            sidestep: sidestep.unwrap_or(0.0),
            velocity: request.velocity.map_or([0.0; 3], |velocity| [velocity.ahead, velocity.left, velocity.turn]),
            places,
            place_count: count,
            place_kind: kind,
            place_frame: frame,
            place_marks: marks,
            age_limit: request.timeout.unwrap_or(0.0),
            id: request.id,
            expires_ns: request.expires_ns.unwrap_or(0),
        }
    }
}

#[cfg(test)]
mod tests {
    use interface::{Destination, Footstep, PlaceFrame, PlaceList, Places, Source, WalkPose};
    use model::Side;

    use super::*;

    #[test]
    fn absent_fields_are_ignored() {
        let gait = GaitChange { turn: Some(0.1), ..GaitChange::NONE };
        let request = Request { gait, intent: Some(Intent::Walk), ..Request::new(Source::Console) };
        let mut message = RequestMessage::from(&request);
        message.speed = f64::NAN;
        assert_eq!(message.checked(), Ok(request));
    }

    #[test]
    fn id_and_expiry_survive_the_message() {
        let request = Request { id: 7, expires_ns: Some(12), ..Request::new(Source::Program) };
        assert_eq!(RequestMessage::from(&request).checked(), Ok(request));
    }

    #[test]
    fn a_destination_survives_the_message_and_is_checked_if_there_is_one() {
        let footstep = Footstep { side: Side::Left, sole: WalkPose { x: 0.3, y: 0.1, heading: 0.2 } };
        let places = Places::Footsteps(PlaceList::new(&[footstep]).unwrap());
        let destination = Some(Destination { frame: PlaceFrame::Robot, places });
        let request = Request { destination, ..Request::new(Source::Console) };
        let message = RequestMessage::from(&request);
        assert_eq!(message.checked(), Ok(request));
        let mut odd = RequestMessage { place_count: 2, ..message };
        odd.places[3] = f64::NAN;
        assert_eq!(odd.checked().unwrap_err().to_string(), "request: place 2: x is NaN; it must be finite");
        let absent = RequestMessage { present: 0, place_kind: 9, ..odd };
        assert_eq!(absent.checked(), Ok(Request::new(Source::Console)));
    }

    #[test]
    fn only_a_streamed_request_has_a_timeout() {
        for (lifetime, timeout, arrives) in [
            (Lifetime::Streamed, Some(0.3), Some(0.3)),
            (Lifetime::Streamed, None, None),
            (Lifetime::Latched, Some(0.3), None),
            (Lifetime::Release, Some(0.3), None),
        ] {
            let request = Request { lifetime, timeout, ..Request::new(Source::Teleop) };
            let checked = RequestMessage::from(&request).checked();
            assert_eq!(checked, Ok(Request { timeout: arrives, ..request }));
        }
    }

    #[test]
    fn present_fields_are_checked() {
        let good = RequestMessage::from(&Request {
            intent: Some(Intent::Stop),
            gait: GaitChange { speed: Some(1.2), ..GaitChange::NONE },
            ..Request::new(Source::Script)
        });
        let text = |message: RequestMessage| message.checked().unwrap_err().to_string();
        assert_eq!(text(RequestMessage { speed: f64::NAN, ..good }), "request: speed is NaN; it must be finite");
        assert!(text(RequestMessage { intent: 9, ..good }).starts_with("request: intent is 9; known are 1 (walk)"));
        assert!(
            text(RequestMessage { source: 77, ..good }).starts_with("request: source is 77; known are 0 (console)")
        );
        assert!(text(RequestMessage { lasting: 3, ..good }).starts_with("request: lasting is 3; known are 0 (until"));
        let stream = RequestMessage { lasting: Lifetime::Streamed.code(), ..good };
        let aged = |age_limit| text(RequestMessage { age_limit, ..stream });
        assert_eq!(aged(-1.0), "request: age_limit is -1; it must be at least 0");
        assert_eq!(aged(f64::INFINITY), "request: age_limit is inf; it must be finite");
        assert!(text(RequestMessage { present: 256, ..good }).starts_with("request: present is 256; known are sums"));
    }
}
