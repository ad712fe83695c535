//! The hips' height: the nominal's, lowered smoothly where a long step would stretch a leg.

use dynamics::{Kinematics, Leg};
use gait::Walk;
use model::{Joint, Side};
use nalgebra::Vector2;

use crate::preview::swing_path::smooth_step;
use crate::preview::{Biped, SolePose};

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
/// How far the hips may be off where they are expected [m].
const HIPS_OFF: f64 = 0.04;
/// Progress at which the swinging leg may be longest: the foot is ahead before the body has come after.
const LATE: [f64; 6] = [0.6, 0.7, 0.8, 0.85, 0.9, 1.0];

impl HipHeight {
    /// Begins with the nominal half-step.
    pub fn new(Biped { tree, mechanism, .. }: &Biped, walk: &Walk) -> Self {
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

    /// A half-step begins.
    ///
    /// * `swinging` – the swinging sole at a progress
    /// * `half_duration` – half the half-step's duration times the pendulum's rate
    pub fn begin_half_step(&mut self, half_duration: f64, swinging: impl Fn(f64) -> SolePose) {
        self.lowered_at_swap = self.lowered_at_end;
        self.lowered_at_start = self.lowered_at_end;
        let width = Vector2::new(0.0, self.hip_width);
        let middle = (swinging(1.0).position.xy() - width) / 2.0;
        let lowered = LATE.map(|progress| {
            // The pendulum of a steady walk (Kajita 2001): slow walks stay long over the bearing foot.
            let passed = sinh(half_duration * (2.0 * progress - 1.0)) / sinh(half_duration);
            let reach = swinging(progress).position.xy() - width - middle * passed;
            self.needed(reach.norm() + HIPS_OFF)
        });
        self.lowered_at_end = lowered.into_iter().fold(0.0, f64::max);
    }

    /// Crouches for a start from a stand: the pelvis goes over the bearing foot while the other one, at `standing`, is still
    /// on the ground. Done before the shift of weight, of which `shifted` has passed, gets far.
    pub fn crouch(&mut self, standing: &SolePose, shifted: f64) {
        let spread = standing.position.xy() - Vector2::new(0.0, self.hip_width);
        let needed = self.needed(spread.norm() + HIPS_OFF).max(self.lowered_at_swap);
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

/// To 1 % up to 2: no function of the system's mathematical library gets into a joint.
fn sinh(x: f64) -> f64 {
    let square = x * x;
    x * (1.0 + square / 6.0 * (1.0 + square / 20.0 * (1.0 + square / 42.0)))
}
