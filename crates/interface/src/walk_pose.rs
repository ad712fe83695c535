//! Where the robot is, in the frame in which its walk began.

/// A place on the floor with a heading, in the **walk frame**: origin in the middle between the feet when the
/// controller started, x ahead, y to the left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WalkPose {
    /// Along x (m).
    pub x: f64,
    /// Along y (m).
    pub y: f64,
    /// Heading (rad), positive to the left; it counts on beyond π.
    pub heading: f64,
}

/// A velocity on the floor, seen from the robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WalkVelocity {
    /// Ahead (m/s).
    pub ahead: f64,
    /// To the left (m/s).
    pub left: f64,
    /// Turning to the left (rad/s).
    pub turn: f64,
}

impl WalkVelocity {
    /// Whether it is exactly none: a stand.
    pub fn is_zero(&self) -> bool {
        *self == Self::default()
    }

    /// Whether every component is a finite number.
    pub fn is_finite(&self) -> bool {
        [self.ahead, self.left, self.turn].into_iter().all(f64::is_finite)
    }

    /// A share of it: the same direction and the same arc.
    #[must_use]
    pub fn scaled(&self, share: f64) -> Self {
        Self { ahead: self.ahead * share, left: self.left * share, turn: self.turn * share }
    }
}

/// What gait parameters come to once the walk is steady.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SteadyWalk {
    /// How far ahead of the other foot each foot lands (m); negative backward.
    pub step_ahead: f64,
    /// How far a full step goes aside (m), positive to the left; what a turn adds is not counted.
    pub step_aside: f64,
    /// Mean velocity over a full step.
    pub velocity: WalkVelocity,
}

impl SteadyWalk {
    /// No step.
    pub const ZERO: Self =
        Self { step_ahead: 0.0, step_aside: 0.0, velocity: WalkVelocity { ahead: 0.0, left: 0.0, turn: 0.0 } };
}

/// Where the robot is, how it moves, and where its feet are to land: in the walk frame, as the controller estimates it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Odometry {
    /// The middle between both soles, with the mean of their headings.
    pub pose: WalkPose,
    /// Mean velocity over the last full step.
    pub velocity: WalkVelocity,
    /// The sole of the support foot.
    pub support_sole: WalkPose,
    /// The next landings: of the other foot, then of this one.
    pub landings: [WalkPose; 2],
}
