//! Which messages are requests that a controller of this version can grant.

use interface::{Lifetime, Reason, Request, Source};
use wire::{MessageFault, RequestMessage};

/// Why no controller of this version can grant a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Invalid {
    pub reason: Reason,
    /// The place of a destination that it is about.
    pub place: Option<u32>,
}

/// The request of a message.
///
/// # Errors
/// Why no controller of this version can grant it.
pub(crate) fn valid(message: &RequestMessage) -> Result<Request, Invalid> {
    let because = |reason| Invalid { reason, place: None };
    let request = message.checked().map_err(|fault| match fault {
        MessageFault::PlaceNotFinite { place, .. } => Invalid { reason: Reason::NotFinite, place: Some(place) },
        MessageFault::NotFinite { .. } => because(Reason::NotFinite),
        MessageFault::PlaceCount { value: 0, .. } => because(Reason::Empty),
        MessageFault::PlaceCount { .. } => because(Reason::TooManyPlaces),
        _ => because(Reason::UnknownCode),
    })?;
    if request.source == Source::ControlLoop {
        return Err(because(Reason::UnknownCode));
    }
    // In a stream an empty request is a heartbeat or the end; by itself it is a mistake.
    if request.is_empty() && request.lifetime == Lifetime::Latched { Err(because(Reason::Empty)) } else { Ok(request) }
}

#[cfg(test)]
mod tests {
    use interface::{Destination, GaitChange, Intent, PlaceFrame, PlaceList, Places, Waypoint};

    use super::*;

    #[test]
    fn an_empty_request_is_refused_unless_it_belongs_to_a_stream() {
        let empty = Request::new(Source::Console);
        assert_eq!(valid(&(&empty).into()), Err(Invalid { reason: Reason::Empty, place: None }));
        for lifetime in [Lifetime::Streamed, Lifetime::Release] {
            let request = Request { lifetime, ..empty };
            assert_eq!(valid(&(&request).into()), Ok(request));
        }
    }

    #[test]
    fn no_operator_may_claim_to_be_the_control_loop() {
        let request = Request { intent: Some(Intent::Hold), ..Request::new(Source::ControlLoop) };
        assert_eq!(valid(&(&request).into()), Err(Invalid { reason: Reason::UnknownCode, place: None }));
    }

    #[test]
    fn a_request_that_is_not_finite_is_refused() {
        let gait = GaitChange { speed: Some(1.0), ..GaitChange::NONE };
        let request = Request { gait, ..Request::new(Source::Script) };
        let message = RequestMessage { speed: f64::NAN, ..RequestMessage::from(&request) };
        assert_eq!(valid(&message), Err(Invalid { reason: Reason::NotFinite, place: None }));
    }

    #[test]
    fn a_place_that_is_not_finite_is_named_and_too_many_are_refused() {
        let waypoint = Waypoint { x: 1.0, y: 0.0, heading: None };
        let places = Places::Waypoints(PlaceList::new(&[waypoint; 8]).unwrap());
        let destination = Some(Destination { frame: PlaceFrame::Walk, places });
        let mut message = RequestMessage::from(&Request { destination, ..Request::new(Source::Script) });
        for (place_count, reason) in [(0, Reason::Empty), (25, Reason::TooManyPlaces)] {
            let counted = RequestMessage { place_count, ..message };
            assert_eq!(valid(&counted), Err(Invalid { reason, place: None }));
        }
        assert!(valid(&message).is_ok());
        message.places[19] = f64::NAN;
        assert_eq!(valid(&message), Err(Invalid { reason: Reason::NotFinite, place: Some(7) }));
    }
}
