//! Destinations to ask for, and how far from them a robot is.

use dynamics::{pose_seen_from, poses_in_frame_of};
use interface::{Destination, Footstep, PlaceFrame, PlaceList, Places, Request, Source, WalkPose, Waypoint};
use model::Side;
use nalgebra::Vector3;
use rand::{Rng, rngs::StdRng};

use crate::velocity::to_half_circle;
use crate::walking::Walking;

/// Steps of a random list.
pub const STEPS: usize = 12;

/// A request to walk to a destination in the walk frame.
pub fn walk_to(places: Places) -> Request {
    let destination = Some(Destination { frame: PlaceFrame::Walk, places });
    Request { destination, ..Request::new(Source::Console) }
}

/// A request to walk through poses of which the last one is the goal.
pub fn walk_through(poses: &[WalkPose]) -> Request {
    let waypoints: Vec<_> =
        poses.iter().map(|pose| Waypoint { x: pose.x, y: pose.y, heading: Some(pose.heading) }).collect();
    walk_to(Places::Waypoints(PlaceList::new(&waypoints).expect("a few places")))
}

/// A request to make footsteps.
pub fn step_to(footsteps: &[Footstep]) -> Request {
    walk_to(Places::Footsteps(PlaceList::new(footsteps).expect("a few places")))
}

/// Steps as the built-in robot can make them, right and left in turn, from a stand with the feet side by side at the
/// origin. All go about the same way: ahead or back, aside, turning.
pub fn random_footsteps(random: &mut StdRng, first: Side) -> [Footstep; STEPS] {
    let width = crate::mechanism().foot_distance();
    let mut side = first;
    let mut support = WalkPose { y: -0.5 * width * lateral(first), ..WalkPose::default() };
    let ahead = random.random_range(-0.15..0.25);
    let (aside, turn) = (random.random_range(0.0..0.08), random.random_range(0.0..0.25));
    let leads = if random.random() { Side::Left } else { Side::Right };
    std::array::from_fn(|_| {
        let share = if side == leads { 1.0 } else { 0.0 };
        let y = lateral(side) * (width + share * aside + random.random_range(0.0..0.03));
        let heading = lateral(side) * (share * turn + random.random_range(0.0..0.05));
        let [sole] =
            poses_in_frame_of(&support, &[WalkPose { x: ahead + random.random_range(-0.05..0.05), y, heading }]);
        support = sole;
        let footstep = Footstep { side, sole };
        side = side.other();
        footstep
    })
}

/// 1 for the left foot, which is on the side of positive y, −1 for the right one.
fn lateral(side: Side) -> f64 {
    -side.lateral_sign()
}

/// A sole in the world, by the plant.
pub fn true_sole(walking: &Walking, side: Side) -> WalkPose {
    let sole = walking.plant.truth().soles[side.index()];
    let ahead = sole.rotation * Vector3::x();
    WalkPose { x: sole.translation.x, y: sole.translation.y, heading: ahead.y.atan2(ahead.x) }
}

/// How far one pose is from another: m and rad.
pub fn pose_error(expected: &WalkPose, found: &WalkPose) -> [f64; 2] {
    let seen = pose_seen_from(expected, found);
    [seen.x.hypot(seen.y), to_half_circle(seen.heading).abs()]
}
