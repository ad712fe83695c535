//! The hips' height: the nominal's, lowered smoothly where a long step would stretch a leg.

use dynamics::{Kinematics, Leg, Tree};
use gait::Walk;
use model::{Joint, Mechanism, Side};
use nalgebra::Vector2;

use crate::preview::SolePose;
use crate::preview::swing_path::smooth_step;

/// By how much the hips are lowered over a half-step.
#[derive(Clone, Copy, Debug)]
pub struct HipHeight {
    /// Hip above ankle at the nominal's swap [m].
    above_ankle: f64,
    /// Largest distance of hip and ankle [m].
    leg_max: f64,
    hip_width: f64,
    lowered_at_start: f64,
    lowered_at_end: f64,
    /// As the half-step began, before any crouch.
    lowered_at_swap: f64,
}

/// Share of the legs' length that is used at most: the knee keeps a bend of 19°.
const LEG_SHARE_MAX: f64 = 0.987;
/// How far the pelvis may be off the middle of both feet when the foot lands [m].
const PELVIS_OFF_MIDDLE: f64 = 0.06;

impl HipHeight {
    /// Begins with the nominal half-step.
    pub fn new(tree: &Tree, mechanism: &Mechanism, walk: &Walk) -> Self {
        let end = Kinematics::standing(tree, &walk.table().at(1.0).angles);
        let length = |joint: Joint| mechanism.links[joint].origin.norm();
        Self {
            above_ankle: end.origin[Leg(Side::Right).end()].z - mechanism.sole.ankle_height,
            leg_max: LEG_SHARE_MAX * (length(Joint::RightKnee) + length(Joint::RightHipPitch)),
            hip_width: mechanism.links[Joint::LeftHipRoll].origin.y,
            lowered_at_start: 0.0,
            lowered_at_end: 0.0,
            lowered_at_swap: 0.0,
        }
    }

    /// A half-step begins that ends at `landing`.
    pub fn begin_half_step(&mut self, landing: &SolePose) {
        let spread = landing.position.xy() - Vector2::new(0.0, self.hip_width);
        self.lowered_at_swap = self.lowered_at_end;
        self.lowered_at_start = self.lowered_at_end;
        self.lowered_at_end = self.needed(spread.norm() / 2.0 + PELVIS_OFF_MIDDLE);
    }

    /// Crouches for a start from a stand: the pelvis goes over the bearing foot while the other one, at `standing`, is still
    /// on the ground. Done before the shift of weight, of which `shifted` has passed, gets far.
    pub fn crouch(&mut self, standing: &SolePose, shifted: f64) {
        let spread = standing.position.xy() - Vector2::new(0.0, self.hip_width);
        let needed = self.needed(spread.norm() + PELVIS_OFF_MIDDLE).max(self.lowered_at_swap);
        let done = smooth_step((2.0 * shifted).min(1.0));
        self.lowered_at_start = self.lowered_at_swap + (needed - self.lowered_at_swap) * done;
    }

    /// By how much the hips must be lowered for a leg to reach so far from under its hip [m].
    fn needed(&self, reach: f64) -> f64 {
        (self.above_ankle - (self.leg_max * self.leg_max - reach * reach).max(0.0).sqrt()).max(0.0)
    }

    /// How much lower than the nominal's the hips are at a progress [m].
    pub fn lowered(&self, progress: f64) -> f64 {
        self.lowered_at_start + (self.lowered_at_end - self.lowered_at_start) * smooth_step(progress)
    }
}
