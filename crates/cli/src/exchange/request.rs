//! Request, operator → wire → controller.

use controller::Intent;
use wire::{MessageFault, Reason, RequestMessage};

/// The tick before which it must not take effect, and what is asked of gait and controller.
///
/// # Errors
/// Why no controller of this version can grant it.
pub fn for_controller(message: &RequestMessage) -> Result<(u64, (gait::Request, Option<Intent>)), Reason> {
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
        // A robot that lies cannot get up, so that there is nothing to reset to.
        Some(wire::Intent::Reset) => return Err(Reason::NoWayBack),
    };
    let request = gait::Request { turn, speed, extension };
    if request == gait::Request::default() && intent.is_none() {
        return Err(Reason::Empty);
    }
    Ok((not_before, (request, intent)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_asks_for_nothing_is_refused() {
        let empty = wire::Request::by(wire::Source::Console);
        assert_eq!(for_controller(&(&empty).into()), Err(Reason::Empty));
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
        let (not_before, (asked, intent)) = for_controller(&(&request).into()).unwrap();
        assert_eq!((not_before, intent), (5, Some(Intent::Stop)));
        assert_eq!(asked, gait::Request { turn: Some(0.1), speed: None, extension: None });
    }
}
