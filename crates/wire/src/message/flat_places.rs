//! A destination as flat numbers: three for each place, and one bit.

use interface::{Destination, Footstep, PLACES_MAX, PlaceFrame, PlaceList, Places, WalkPose, Waypoint};
use model::Side;

use super::MessageFault;
use super::fault::Check;

/// Numbers of a place: x, y, heading.
const PER_PLACE: usize = 3;
/// Numbers of all places.
const NUMBERS: usize = PER_PLACE * PLACES_MAX;

/// The kinds of places, as numbers.
const WAYPOINTS: u32 = 0;
const FOOTSTEPS: u32 = 1;
/// The frames of places, as numbers.
const WALK: u32 = 0;
const ROBOT: u32 = 1;

/// The fields of a request that hold its destination.
pub(super) struct FlatPlaces {
    pub(super) places: [f64; NUMBERS],
    pub(super) count: u32,
    pub(super) kind: u32,
    pub(super) frame: u32,
    pub(super) marks: u32,
}

impl FlatPlaces {
    /// The fields of a request without a destination.
    pub(super) const NONE: Self = Self { places: [0.0; NUMBERS], count: 0, kind: 0, frame: 0, marks: 0 };

    /// The destination, if there are places, not too many, its codes are known, and its numbers finite.
    pub(super) fn checked(&self, check: &Check) -> Result<Destination, MessageFault> {
        let unknown = |field, value, known| MessageFault::UnknownCode { message: check.0, field, value, known };
        let frame = match self.frame {
            WALK => PlaceFrame::Walk,
            ROBOT => PlaceFrame::Robot,
            value => return Err(unknown("place_frame", value, "0 (walk) 1 (robot)")),
        };
        let indices: [usize; PLACES_MAX] = std::array::from_fn(|index| index);
        let indices = indices.get(..self.count as usize).and_then(PlaceList::new);
        let indices = indices.ok_or(MessageFault::PlaceCount { message: check.0, value: self.count })?;
        for &index in indices.iter() {
            self.check_place(check, index)?;
        }
        let places = match self.kind {
            WAYPOINTS => Places::Waypoints(indices.map(|index| {
                let WalkPose { x, y, heading } = self.pose(index);
                Waypoint { x, y, heading: self.is_marked(index).then_some(heading) }
            })),
            FOOTSTEPS => Places::Footsteps(indices.map(|index| {
                let side = if self.is_marked(index) { Side::Left } else { Side::Right };
                Footstep { side, sole: self.pose(index) }
            })),
            value => return Err(unknown("place_kind", value, "0 (way-points) 1 (footsteps)")),
        };
        Ok(Destination { frame, places })
    }

    fn check_place(&self, check: &Check, index: usize) -> Result<(), MessageFault> {
        let WalkPose { x, y, heading } = self.pose(index);
        let has_heading = self.kind == FOOTSTEPS || self.is_marked(index);
        let numbers = [("x", x), ("y", y), ("heading", if has_heading { heading } else { 0.0 })];
        match numbers.into_iter().find(|(_, value)| !value.is_finite()) {
            None => Ok(()),
            Some((field, value)) => {
                Err(MessageFault::PlaceNotFinite { message: check.0, place: index as u32 + 1, field, value })
            }
        }
    }

    fn pose(&self, index: usize) -> WalkPose {
        let [x, y, heading] = std::array::from_fn(|number| self.places[PER_PLACE * index + number]);
        WalkPose { x, y, heading }
    }

    fn is_marked(&self, index: usize) -> bool {
        self.marks & (1 << index) != 0
    }

    fn set(&mut self, index: usize, numbers: [f64; PER_PLACE], is_marked: bool) {
        self.places[PER_PLACE * index..][..PER_PLACE].copy_from_slice(&numbers);
        self.marks |= u32::from(is_marked) << index;
    }
}

impl From<&Destination> for FlatPlaces {
    fn from(destination: &Destination) -> Self {
        let frame = match destination.frame {
            PlaceFrame::Walk => WALK,
            PlaceFrame::Robot => ROBOT,
        };
        let count = destination.places.count() as u32;
        let mut flat = Self { count, frame, ..Self::NONE };
        match &destination.places {
            Places::Waypoints(waypoints) => {
                flat.kind = WAYPOINTS;
                for (index, Waypoint { x, y, heading }) in waypoints.iter().enumerate() {
                    flat.set(index, [*x, *y, heading.unwrap_or(0.0)], heading.is_some());
                }
            }
            Places::Footsteps(footsteps) => {
                flat.kind = FOOTSTEPS;
                for (index, Footstep { side, sole }) in footsteps.iter().enumerate() {
                    flat.set(index, [sole.x, sole.y, sole.heading], *side == Side::Left);
                }
            }
        }
        flat
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waypoint(number: usize) -> Waypoint {
        let heading = number.is_multiple_of(3).then_some(0.1 * number as f64);
        Waypoint { x: number as f64, y: -0.5, heading }
    }

    fn footstep(number: usize) -> Footstep {
        let side = if number.is_multiple_of(2) { Side::Left } else { Side::Right };
        Footstep { side, sole: WalkPose { x: 0.2 * number as f64, y: 0.1, heading: -0.3 } }
    }

    fn list<T: Copy>(count: usize, place: fn(usize) -> T) -> PlaceList<T> {
        PlaceList::new(&(0..count).map(place).collect::<Vec<_>>()).unwrap()
    }

    fn walk(places: Places) -> FlatPlaces {
        (&Destination { frame: PlaceFrame::Walk, places }).into()
    }

    fn checked(flat: &FlatPlaces) -> Result<Destination, String> {
        flat.checked(&Check("request")).map_err(|fault| fault.to_string())
    }

    #[test]
    fn every_destination_survives_its_numbers() {
        for count in [1, 2, PLACES_MAX] {
            for places in [Places::Waypoints(list(count, waypoint)), Places::Footsteps(list(count, footstep))] {
                for frame in [PlaceFrame::Walk, PlaceFrame::Robot] {
                    let destination = Destination { frame, places };
                    assert_eq!(checked(&(&destination).into()), Ok(destination));
                }
            }
        }
    }

    #[test]
    fn a_number_that_is_not_finite_is_named_with_its_place() {
        let set = |places: Places, at: usize, value: f64| {
            let mut flat = walk(places);
            flat.places[at] = value;
            checked(&flat).unwrap_err()
        };
        let (ways, steps) = (Places::Waypoints(list(7, waypoint)), Places::Footsteps(list(24, footstep)));
        assert_eq!(set(ways, 18, f64::NAN), "request: place 7: x is NaN; it must be finite");
        assert_eq!(set(ways, 1, f64::INFINITY), "request: place 1: y is inf; it must be finite");
        assert_eq!(set(ways, 20, f64::NAN), "request: place 7: heading is NaN; it must be finite");
        assert_eq!(set(steps, 71, f64::NAN), "request: place 24: heading is NaN; it must be finite");
    }

    #[test]
    fn what_is_not_given_is_ignored() {
        let mut flat = walk(Places::Waypoints(list(2, waypoint)));
        flat.places[6..].fill(f64::NAN);
        flat.places[5] = f64::NAN;
        flat.marks |= 1 << 30;
        let read = checked(&flat).unwrap().places;
        assert_eq!(read, Places::Waypoints(list(2, waypoint)), "place 2 has no heading, and there is no place 3");
    }

    #[test]
    fn unknown_codes_and_counts_are_refused() {
        let flat = || walk(Places::Footsteps(list(2, footstep)));
        let text = |flat: FlatPlaces| checked(&flat).unwrap_err();
        for count in [0, 25, u32::MAX] {
            let told = text(FlatPlaces { count, ..flat() });
            assert_eq!(told, format!("request: place_count is {count}; there must be 1 to 24 places"));
        }
        let kind = text(FlatPlaces { kind: 2, ..flat() });
        assert_eq!(kind, "request: place_kind is 2; known are 0 (way-points) 1 (footsteps)");
        let frame = text(FlatPlaces { frame: 9, ..flat() });
        assert_eq!(frame, "request: place_frame is 9; known are 0 (walk) 1 (robot)");
    }
}
