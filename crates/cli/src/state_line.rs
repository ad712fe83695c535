//! The state of a walk in one line, and its parts: the same for the progress of `walk`, for `watch` and `status`.

use interface::{DestinationProgress, Report, WalkPose, WalkVelocity};

/// How far it is to a destination: `goal in 1.2 m, 3 places left`.
pub(crate) fn goal_text(progress: &DestinationProgress) -> String {
    let DestinationProgress { places_left, distance, .. } = *progress;
    match places_left {
        0 => "at the goal".to_owned(),
        1 => format!("goal in {distance:.1} m, 1 place left"),
        _ => format!("goal in {distance:.1} m, {places_left} places left"),
    }
}

/// Where the robot is and how it moves, with the least margin (m), in 59 columns: a line of 80 has room for more.
pub(crate) fn state_line(report: &Report, margin: Option<f64>) -> String {
    let WalkPose { x, y, heading } = report.odometry.pose;
    let margin = margin.map_or("   –".to_owned(), |margin| format!("{:4.0}", tenths(margin * 1e3)));
    format!(
        "{:<9}x {:6.2} y {:6.2} m {:4.0}° {:5.2} m/s margin {margin} mm",
        report.mode.text(),
        hundredths(x),
        hundredths(y),
        tenths(heading.to_degrees()),
        hundredths(report.odometry.velocity.ahead),
    )
}

/// A pose in words.
pub(crate) fn pose_text(pose: &WalkPose) -> String {
    let WalkPose { x, y, heading } = *pose;
    let heading = tenths(heading.to_degrees());
    format!("x {:.2} m, y {:.2} m, heading {heading:.1}°", hundredths(x), hundredths(y))
}

/// A velocity in words.
pub(crate) fn velocity_text(velocity: &WalkVelocity) -> String {
    let WalkVelocity { ahead, left, turn } = *velocity;
    let turn = tenths(turn.to_degrees());
    format!("ahead {:.2} m/s, left {:.2} m/s, turn {turn:.1} °/s", hundredths(ahead), hundredths(left))
}

/// A number rounded to two digits: a small negative one loses its sign.
pub(crate) fn hundredths(value: f64) -> f64 {
    (value * 100.0).round() / 100.0 + 0.0
}

fn tenths(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}

#[cfg(test)]
mod tests {
    use interface::{Mode, Odometry};

    use super::*;

    #[test]
    fn a_line_has_the_same_width_whatever_the_robot_does() {
        let pose = WalkPose { x: -123.456, y: -0.001, heading: -3.1 };
        let velocity = WalkVelocity { ahead: -0.45, left: 0.0, turn: 0.0 };
        let moved =
            Report { odometry: Odometry { pose, velocity, ..Odometry::default() }, ..Report::of(Mode::Walking) };
        assert_eq!(state_line(&moved, Some(-0.0123)), "walking  x -123.46 y   0.00 m -178° -0.45 m/s margin  -12 mm");
        for mode in Mode::ALL {
            assert_eq!(state_line(&Report::of(*mode), None).chars().count(), 59, "{mode}");
        }
    }
}
