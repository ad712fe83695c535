//! Request, operator → wire → controller.

use controller::{Asked, Intent, Lasting};
use wire::{MessageFault, Reason, RequestMessage};

use super::source;

/// The tick before which it must not take effect, and what is asked.
///
/// # Errors
/// Why no controller of this version can grant it.
pub fn for_controller(message: &RequestMessage) -> Result<(u64, Asked), Reason> {
    let request = message.checked().map_err(|fault| match fault {
        MessageFault::NotFinite { .. } => Reason::NotFinite,
        _ => Reason::NotUnderstood,
    })?;
    let wire::Request { not_before, turn, speed, extension, .. } = request;
    let intent = match request.intent {
        None => None,
        Some(wire::Intent::Walk) => Some(Intent::Walk),
        Some(wire::Intent::Stop) => Some(Intent::Stop),
        Some(wire::Intent::Hold) => Some(Intent::Hold),
        Some(wire::Intent::Reset) => Some(Intent::Reset),
        Some(wire::Intent::InPlace) => Some(Intent::InPlace),
    };
    let lasting = match request.lasting {
        wire::Lasting::UntilChanged | wire::Lasting::Farewell => Lasting::UntilChanged,
        wire::Lasting::WhileSpeaking => Lasting::WhileSpeaking(request.age_limit),
    };
    let source = source::for_controller(request.source);
    let asked = Asked { request: gait::Request { turn, speed, extension }, intent, source, lasting };
    // Of a stream that is a sign of life or a good-bye; of anybody else it is a mistake.
    if asked.is_empty() && request.lasting == wire::Lasting::UntilChanged {
        return Err(Reason::Empty);
    }
    Ok((not_before, asked))
}

#[cfg(test)]
mod tests {
    use controller::Source;

    use super::*;

    #[test]
    fn what_asks_for_nothing_is_refused_unless_it_is_of_a_stream() {
        let empty = wire::Request::by(wire::Source::Console);
        assert_eq!(for_controller(&(&empty).into()), Err(Reason::Empty));
        for (lasting, age_limit, arrives) in [
            (wire::Lasting::WhileSpeaking, None, Lasting::WhileSpeaking(None)),
            (wire::Lasting::WhileSpeaking, Some(2.0), Lasting::WhileSpeaking(Some(2.0))),
            (wire::Lasting::Farewell, None, Lasting::UntilChanged),
        ] {
            let (_, asked) = for_controller(&(&wire::Request { lasting, age_limit, ..empty }).into()).unwrap();
            assert!(asked.is_empty());
            assert_eq!(asked.lasting, arrives);
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        let request = wire::Request { speed: Some(1.0), ..wire::Request::by(wire::Source::Script) };
        let message = RequestMessage { speed: f64::NAN, ..RequestMessage::from(&request) };
        assert_eq!(for_controller(&message), Err(Reason::NotFinite));
    }

    #[test]
    fn what_is_asked_arrives() {
        let request = wire::Request {
            not_before: 5,
            intent: Some(wire::Intent::Stop),
            turn: Some(0.1),
            ..wire::Request::by(wire::Source::Script)
        };
        let (not_before, asked) = for_controller(&(&request).into()).unwrap();
        assert_eq!((not_before, asked.source, asked.lasting), (5, Source::Script, Lasting::UntilChanged));
        assert_eq!(asked.request, gait::Request { turn: Some(0.1), speed: None, extension: None });
        assert!(asked.is_stop());
    }
}
