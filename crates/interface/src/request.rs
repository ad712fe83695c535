//! A request of an operator.

use crate::{Destination, GaitChange, Intent, Lifetime, Source, WalkVelocity};

/// A request of an operator. It is atomic: it takes effect as a whole or not at all. The one exception is a stop, which
/// takes effect before the gait parameters of the same request are evaluated. From a source that is outranked, only the
/// stop is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// The controller's tick before which it must not take effect; 0 is at once.
    pub not_before: u64,
    /// Where it comes from.
    pub source: Source,
    /// Gait parameters to change.
    pub gait: GaitChange,
    /// The velocity to walk at, instead of gait parameters; zero is a stand. It starts the walk.
    pub velocity: Option<WalkVelocity>,
    /// Where to walk to, instead of how. A speed in `gait` holds for the way there. Whatever else moves the robot
    /// cancels it: other gait parameters, a velocity, an intent, the end of a stream.
    pub destination: Option<Destination>,
    /// What the robot is to do; `None` leaves the intent as it is.
    pub intent: Option<Intent>,
    /// How long it stays in effect.
    pub lifetime: Lifetime,
    /// Command timeout of a streamed request (s); `None` is the controller's own. Other lifetimes ignore it.
    pub timeout: Option<f64>,
    /// A number of the sender's choice, which the [`Reply`](crate::Reply) repeats; 0 if it chose none.
    pub id: u64,
    /// When it expires, by `CLOCK_MONOTONIC` (ns): if it is not submitted to the controller by then it is refused.
    /// `None` is never. A stop does not expire.
    pub expires_ns: Option<u64>,
}

impl Request {
    /// An empty, latched request for at once, to be filled in.
    pub const fn new(source: Source) -> Self {
        Self {
            not_before: 0,
            source,
            gait: GaitChange::NONE,
            velocity: None,
            destination: None,
            intent: None,
            lifetime: Lifetime::Latched,
            timeout: None,
            id: 0,
            expires_ns: None,
        }
    }

    /// Whether it changes nothing: a heartbeat, or the end of a stream.
    pub fn is_empty(&self) -> bool {
        self.gait == GaitChange::NONE && self.velocity.is_none() && self.destination.is_none() && self.intent.is_none()
    }

    /// Whether it ends the walk, which is granted to every source: by its intent, or by no velocity.
    pub fn is_stop(&self) -> bool {
        self.intent.map_or_else(|| self.velocity.is_some_and(|velocity| velocity.is_zero()), Intent::is_stop)
    }

    /// Whether it says in two ways how to walk, or how to walk and not to walk.
    pub fn is_contradictory(&self) -> bool {
        let walks = self.intent.is_none_or(|intent| intent == Intent::Walk);
        match (self.velocity, self.destination) {
            (None, None) => false,
            (Some(_), None) => self.gait != GaitChange::NONE || !walks,
            (None, Some(_)) => GaitChange { speed: None, ..self.gait } != GaitChange::NONE || !walks,
            (Some(_), Some(_)) => true,
        }
    }

    /// Whether it moves the robot otherwise than before, which cancels a destination: a mere change of speed does not.
    pub fn moves(&self) -> bool {
        let GaitChange { turn, extension, sidestep, speed: _ } = self.gait;
        [turn, extension, sidestep].iter().any(Option::is_some)
            || self.velocity.is_some()
            || self.destination.is_some()
            || self.intent.is_some()
    }

    /// Whether a later request of the same source leaves nothing of it in effect. A velocity sets all gait parameters.
    /// A request for something else than the later one's intent is not overridden: the robot is to do one after the
    /// other.
    pub fn is_overridden_by(&self, later: &Request) -> bool {
        let sets = |earlier: Option<f64>, later_one: Option<f64>| {
            earlier.is_none() || later_one.is_some() || later.velocity.is_some()
        };
        self.source == later.source
            && self.lifetime == later.lifetime
            && sets(self.gait.turn, later.gait.turn)
            && sets(self.gait.speed, later.gait.speed)
            && sets(self.gait.extension, later.gait.extension)
            && sets(self.gait.sidestep, later.gait.sidestep)
            && self.velocity.is_none_or(|_| later.velocity.is_some() || later.destination.is_some())
            && self.destination.is_none_or(|_| later.moves())
            && self.intent.is_none_or(|intent| later.intent == Some(intent))
    }

    /// Whether it has expired at a time of `CLOCK_MONOTONIC` (ns). A stop never does.
    pub fn has_expired(&self, time_ns: u64) -> bool {
        !self.is_stop() && self.expires_ns.is_some_and(|expires_ns| expires_ns < time_ns)
    }

    /// Whether it need not wait for the request that is under evaluation: a stop or a heartbeat.
    pub fn is_urgent(&self) -> bool {
        self.is_stop() || self.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use crate::{PlaceFrame, PlaceList, Places, Waypoint};

    use super::*;

    fn asks(turn: Option<f64>, speed: Option<f64>, intent: Option<Intent>) -> Request {
        Request { gait: GaitChange { turn, speed, ..GaitChange::NONE }, intent, ..Request::new(Source::Script) }
    }

    #[test]
    fn a_request_is_overridden_by_a_later_one_that_sets_all_it_sets() {
        let (turn, walk) = (asks(Some(0.1), None, None), asks(None, None, Some(Intent::Walk)));
        assert!(turn.is_overridden_by(&asks(Some(0.2), Some(1.1), None)));
        assert!(!asks(Some(0.2), Some(1.1), None).is_overridden_by(&turn), "the speed would be lost");
        assert!(!turn.is_overridden_by(&Request { source: Source::Teleop, ..turn }));
        assert!(!turn.is_overridden_by(&Request { lifetime: Lifetime::Streamed, ..turn }));
        assert!(walk.is_overridden_by(&walk) && !walk.is_overridden_by(&turn));
        assert!(!asks(None, None, Some(Intent::Reset)).is_overridden_by(&walk), "first the reset, then the walk");
    }

    #[test]
    fn a_velocity_overrides_gait_parameters_and_is_not_overridden_by_them() {
        let velocity = Some(WalkVelocity { ahead: 0.3, ..WalkVelocity::default() });
        let walks_at = Request { velocity, ..Request::new(Source::Script) };
        assert!(asks(Some(0.1), Some(1.2), None).is_overridden_by(&walks_at));
        assert!(walks_at.is_overridden_by(&walks_at));
        assert!(!walks_at.is_overridden_by(&asks(Some(0.1), Some(1.2), None)), "the steps would stay as they are");
    }

    #[test]
    fn a_velocity_goes_with_no_other_way_to_walk() {
        let velocity = Some(WalkVelocity { ahead: 0.3, ..WalkVelocity::default() });
        let with = |request: Request| Request { velocity, ..request }.is_contradictory();
        assert!(!with(asks(None, None, None)) && !with(asks(None, None, Some(Intent::Walk))));
        assert!(with(asks(Some(0.1), None, None)) && with(asks(None, None, Some(Intent::InPlace))));
        assert!(with(asks(None, None, Some(Intent::Stop))));
        assert!(!asks(Some(0.1), None, Some(Intent::Stop)).is_contradictory(), "without a velocity nothing is");
    }

    #[test]
    fn a_destination_goes_with_a_speed_and_is_cancelled_by_whatever_moves_the_robot() {
        let waypoint = Waypoint { x: 1.0, y: 0.0, heading: None };
        let places = Places::Waypoints(PlaceList::new(&[waypoint]).unwrap());
        let destination = Some(Destination { frame: PlaceFrame::Walk, places });
        let with = |request: Request| Request { destination, ..request };
        let goes = with(asks(None, None, None));
        let velocity = Some(WalkVelocity { ahead: 0.3, ..WalkVelocity::default() });
        assert!(!goes.is_empty() && !goes.is_contradictory());
        assert!(!with(asks(None, Some(1.2), Some(Intent::Walk))).is_contradictory());
        assert!(with(asks(Some(0.1), None, None)).is_contradictory());
        assert!(with(asks(None, None, Some(Intent::Stop))).is_contradictory());
        assert!(Request { velocity, ..goes }.is_contradictory());
        assert!(goes.is_overridden_by(&asks(Some(0.1), None, None)) && goes.is_overridden_by(&goes));
        assert!(!goes.is_overridden_by(&asks(None, Some(1.2), None)), "it goes there at that speed");
        assert!(Request { velocity, ..asks(None, None, None) }.is_overridden_by(&goes));
    }

    #[test]
    fn a_stop_does_not_expire() {
        let at = |intent| Request { expires_ns: Some(7), ..asks(None, None, Some(intent)) };
        assert!(at(Intent::Walk).has_expired(8) && !at(Intent::Walk).has_expired(7));
        assert!(!at(Intent::Stop).has_expired(8) && !at(Intent::Hold).has_expired(8));
        assert!(!asks(None, None, Some(Intent::Walk)).has_expired(u64::MAX), "it has no end");
    }
}
