//! Numbers of the size of the robot, in one place so that they can be derived from it.

/// Half the edge of the square around the world's origin that stays even on an uneven floor (m): the robot starts on it
/// with both feet.
pub(crate) const EVEN_HALF_EDGE: f64 = 0.5;

/// A centre of mass below this share of its height when the robot stands straight is a fall: 0.45 m for a human-size
/// robot.
pub(crate) const FALLEN_HEIGHT_SHARE: f64 = 0.453;

/// A trunk tilted further than this against the true vertical is a fall (rad).
pub(crate) const FALLEN_TILT: f64 = std::f64::consts::FRAC_PI_3;
