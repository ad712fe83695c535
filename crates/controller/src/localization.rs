//! Where the robot is, and what destinations mean there.

use dynamics::{atan2, pose_seen_from, poses_in_frame_of, sin_cos};
use interface::{Destination, DestinationProgress, Footstep, PlaceFrame, Places, WalkPose, Waypoint};

/// Where the robot is, as odometry estimates it, in the walk frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Localization {
    /// The middle between both soles.
    pub pose: WalkPose,
    /// The sole of the support foot.
    pub support_sole: WalkPose,
}

impl Localization {
    /// The places of a destination, in the walk frame.
    pub(crate) fn places(&self, destination: &Destination) -> Places {
        let to_walk = |x, y, heading| match destination.frame {
            PlaceFrame::Walk => WalkPose { x, y, heading },
            PlaceFrame::Robot => {
                let [pose] = poses_in_frame_of(&self.pose, &[WalkPose { x, y, heading }]);
                pose
            }
        };
        match destination.places {
            Places::Waypoints(waypoints) => Places::Waypoints(waypoints.map(|Waypoint { x, y, heading }| {
                let pose = to_walk(x, y, heading.unwrap_or(0.0));
                Waypoint { x: pose.x, y: pose.y, heading: heading.map(|_| pose.heading) }
            })),
            Places::Footsteps(footsteps) => Places::Footsteps(
                footsteps.map(|Footstep { side, sole }| Footstep { side, sole: to_walk(sole.x, sole.y, sole.heading) }),
            ),
        }
    }

    /// How far the walk to places has come.
    ///
    /// * `places_left` – how many are still to be reached
    pub(crate) fn progress(&self, places: &Places, places_left: usize) -> DestinationProgress {
        let last = match places {
            Places::Waypoints(waypoints) => waypoints.last().map(|last| {
                let heading = last.heading.unwrap_or(self.pose.heading);
                WalkPose { x: last.x, y: last.y, heading }
            }),
            Places::Footsteps(footsteps) => footsteps.last().map(|last| last.sole),
        };
        let seen = pose_seen_from(&self.pose, &last.unwrap_or(self.pose));
        let (sine, cosine) = sin_cos(seen.heading);
        DestinationProgress {
            places_left: u32::try_from(places_left).unwrap_or(u32::MAX),
            distance: (seen.x * seen.x + seen.y * seen.y).sqrt(),
            turn: atan2(sine, cosine),
        }
    }
}
