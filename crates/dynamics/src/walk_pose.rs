//! Poses on the floor, one seen from the other.

use interface::WalkPose;

use crate::sin_cos;

/// The poses, in the frame in which `outer` is, of what has the poses `inner` in the frame of `outer`.
pub fn poses_in_frame_of<const N: usize>(outer: &WalkPose, inner: &[WalkPose; N]) -> [WalkPose; N] {
    let direction = sin_cos(outer.heading);
    inner.map(|inner| {
        let [x, y] = turned([inner.x, inner.y], direction);
        WalkPose { x: outer.x + x, y: outer.y + y, heading: outer.heading + inner.heading }
    })
}

/// A pose, seen from another pose of the same frame.
pub fn pose_seen_from(outer: &WalkPose, other: &WalkPose) -> WalkPose {
    let [x, y] = turned([other.x - outer.x, other.y - outer.y], sin_cos(-outer.heading));
    WalkPose { x, y, heading: other.heading - outer.heading }
}

/// How far a walk goes from one pose to another if it does so on an arc: seen from itself all along, ahead and to the
/// left (m), and by how much it turns (rad). Headings are not wrapped.
pub fn arc_between(from: &WalkPose, to: &WalkPose) -> WalkPose {
    let turn = to.heading - from.heading;
    let chord = pose_seen_from(&WalkPose { heading: from.heading + 0.5 * turn, ..*from }, to);
    let over_chord = 1.0 / sine_ratio(0.5 * turn);
    WalkPose { x: over_chord * chord.x, y: over_chord * chord.y, heading: turn }
}

/// `sin(x)/x`.
fn sine_ratio(x: f64) -> f64 {
    if x.abs() < 1e-6 { 1.0 } else { sin_cos(x).0 / x }
}

/// A vector, turned by an angle of which sine and cosine are given.
fn turned([x, y]: [f64; 2], (sine, cosine): (f64, f64)) -> [f64; 2] {
    [cosine * x - sine * y, sine * x + cosine * y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seen_from_a_pose_is_there() {
        let here = WalkPose { x: 1.0, y: -2.0, heading: 0.7 };
        let there = WalkPose { x: -0.5, y: 3.0, heading: -2.0 };
        let [back] = poses_in_frame_of(&here, &[pose_seen_from(&here, &there)]);
        assert!((back.x - there.x).abs() < 1e-14 && (back.y - there.y).abs() < 1e-14);
        assert!((back.heading - there.heading).abs() < 1e-15);
    }

    #[test]
    fn a_step_to_the_left_of_a_robot_that_faces_left_goes_back() {
        let facing_left = WalkPose { heading: std::f64::consts::FRAC_PI_2, ..WalkPose::default() };
        let [stepped] = poses_in_frame_of(&facing_left, &[WalkPose { x: 0.0, y: 1.0, heading: 0.0 }]);
        assert!((stepped.x + 1.0).abs() < 1e-12 && stepped.y.abs() < 1e-12);
    }

    /// The oracle: the circle's equation.
    #[test]
    fn an_arc_is_as_long_as_the_way_on_a_circle() {
        let start = WalkPose { x: 1.0, y: -2.0, heading: 0.7 };
        // On a circle of radius 2 m to the left, 0.8 rad far, drifting by nothing; then straight on.
        let (turn, radius) = (0.8_f64, 2.0);
        let way = WalkPose { x: radius * turn.sin(), y: radius * (1.0 - turn.cos()), heading: turn };
        let [end] = poses_in_frame_of(&start, &[way]);
        let arc = arc_between(&start, &end);
        assert!((arc.x - radius * turn).abs() < 1e-12 && arc.y.abs() < 1e-12, "{arc:?}");
        assert_eq!(arc.heading, end.heading - start.heading);
        let straight = arc_between(&start, &poses_in_frame_of(&start, &[WalkPose { x: 0.3, y: 0.1, heading: 0.0 }])[0]);
        assert!((straight.x - 0.3).abs() < 1e-12 && (straight.y - 0.1).abs() < 1e-12, "{straight:?}");
    }
}
