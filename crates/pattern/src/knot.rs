//! Knots: the instants at which the motion is planned.

use interface::WalkPose;
use model::JointVector;
use nalgebra::Vector2;

use crate::footprint::Footprint;

/// Time between knots (s).
pub const KNOT: f64 = 0.01;

/// The motion planned for one knot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot {
    /// Physical joint angles (rad).
    pub angles: JointVector,
    /// The support foot.
    pub footprint: Footprint,
    /// Where the swing foot lands next, and the support foot after it, in the frame of the support foot, not mirrored.
    pub landings: [WalkPose; 2],
    /// Half-steps since the beginning of the walk, with the progress through the present one as fraction.
    pub phase: f64,
    /// The speed factor, 0 in a stand.
    pub speed: f64,
    /// Estimated lean of the vertical over the floor, in the walk frame: x and y of the unit vector (-).
    pub vertical: Vector2<f64>,
    /// Share of the weight on the support foot: 0.5 in a stand, 1 while walking.
    pub support_weight_share: f64,
}
