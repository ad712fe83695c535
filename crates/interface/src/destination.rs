//! Where to walk to: through way-points to a goal pose, or by given footsteps.

use std::ops::Deref;

use model::Side;

use crate::WalkPose;

/// Most way-points or footsteps of a request.
pub const PLACES_MAX: usize = 24;

/// Where to walk to. The robot stands once it is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Destination {
    /// The frame of all places.
    pub frame: PlaceFrame,
    /// Where.
    pub places: Places,
}

/// The frame in which places are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceFrame {
    /// The walk frame, see [`WalkPose`].
    Walk,
    /// The robot's own pose when the request is evaluated: the middle between both soles, with the mean of their
    /// headings.
    Robot,
}

/// The places of a destination, in their order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Places {
    /// Poses of the middle between both soles. The robot walks through all but the last, its goal, where it stands
    /// with its feet side by side.
    Waypoints(PlaceList<Waypoint>),
    /// Soles, right and left in turn. The robot stands as the last two have landed.
    Footsteps(PlaceList<Footstep>),
}

/// A pose to walk through or to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// Along x (m).
    pub x: f64,
    /// Along y (m).
    pub y: f64,
    /// Heading (rad), positive to the left, by whichever way round is nearer; `None` is any.
    pub heading: Option<f64>,
}

/// A footstep: a foot and where its sole lands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footstep {
    /// Which foot.
    pub side: Side,
    /// The point under its ankle, and the heading of its sole.
    pub sole: WalkPose,
}

/// One to [`PLACES_MAX`] places.
#[derive(Clone, Copy, Debug)]
pub struct PlaceList<T> {
    places: [T; PLACES_MAX],
    count: usize,
}

/// How far a walk to a destination has come.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DestinationProgress {
    /// Way-points or footsteps still to come; none once the robot has arrived.
    pub places_left: u32,
    /// From the robot's pose to the last place, as the crow flies (m).
    pub distance: f64,
    /// Heading of the last place against the robot's (rad), within ±π; 0 if any will do.
    pub turn: f64,
}

impl<T: Copy> PlaceList<T> {
    /// A list of these places; `None` if there is none or more than [`PLACES_MAX`].
    pub fn new(places: &[T]) -> Option<Self> {
        let first = *places.first()?;
        let mut list = Self { places: [first; PLACES_MAX], count: places.len() };
        list.places.get_mut(..places.len())?.copy_from_slice(places);
        Some(list)
    }

    /// The same list with each place changed.
    #[must_use]
    pub fn map<U>(&self, change: impl FnMut(T) -> U) -> PlaceList<U> {
        PlaceList { places: self.places.map(change), count: self.count }
    }
}

impl<T> Deref for PlaceList<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.places[..self.count]
    }
}

impl<T: PartialEq> PartialEq for PlaceList<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl Places {
    /// The number of places.
    pub fn count(&self) -> usize {
        match self {
            Places::Waypoints(waypoints) => waypoints.len(),
            Places::Footsteps(footsteps) => footsteps.len(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_has_one_to_as_many_places_as_there_may_be() {
        assert!(PlaceList::<u8>::new(&[]).is_none());
        for count in [1, PLACES_MAX] {
            let places: Vec<usize> = (0..count).collect();
            assert_eq!(*PlaceList::new(&places).unwrap(), *places);
        }
        assert!(PlaceList::new(&[0; PLACES_MAX + 1]).is_none());
    }

    #[test]
    fn lists_are_equal_if_their_places_are() {
        let [one, other] = [[1, 2, 3], [1, 5, 3]].map(|places| PlaceList::new(&places).unwrap());
        assert_ne!(one, other);
        assert_eq!(one.map(|_| 0), other.map(|_| 0));
    }
}
