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
}
