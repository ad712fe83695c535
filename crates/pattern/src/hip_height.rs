//! The height of the hips: that of the nominal half-step, lowered smoothly where a long step would stretch a leg.

use dynamics::Kinematics;
use gait::Walk;
use nalgebra::Vector2;
use signal::smooth_step;

use crate::footprint::SolePose;
use crate::pattern_model::PatternModel;

/// How much lower than the nominal the hips are over a half-step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HipHeight {
    /// Height of the hip over the ankle at the end of the nominal half-step (m).
    above_ankle: f64,
    /// Longest distance of hip and ankle (m).
    leg_length_max: f64,
    /// Largest horizontal offset of the hips from where they are expected (m).
    hip_offset_max: f64,
    /// Distance of the hips (m).
    hip_width: f64,
    /// Lowering at progress 0 (m).
    lowered_at_start: f64,
    /// Lowering at progress 1 (m).
    lowered_at_end: f64,
    /// Lowering when the half-step began, before any crouch (m).
    lowered_at_support_change: f64,
    /// Progress from which on more is lowered for another landing, and how much more at progress 1 (m).
    redirected: (f64, f64),
}

/// Progress at which the swing leg may be longest: the foot is ahead before the body has followed.
const LATE_SWING: [f64; 6] = [0.6, 0.7, 0.8, 0.85, 0.9, 1.0];

impl HipHeight {
    /// Nothing lowered.
    pub(crate) fn new(PatternModel { tree, mechanism, proportions, reach, .. }: &PatternModel, walk: &Walk) -> Self {
        let end = Kinematics::fixed_base(tree, &walk.table().at(1.0).angles);
        Self {
            above_ankle: end.origin[tree.pelvis()].z + reach.hips_in_pelvis[0].z - mechanism.sole.ankle_height,
            leg_length_max: proportions.planned_leg_length_max,
            hip_offset_max: proportions.hip_offset_max,
            hip_width: mechanism.foot_distance(),
            lowered_at_start: 0.0,
            lowered_at_end: 0.0,
            lowered_at_support_change: 0.0,
            redirected: (0.0, 0.0),
        }
    }

    /// Begins a half-step.
    ///
    /// * `half_duration` – half the half-step's duration times the rate of the pendulum (-)
    /// * `swing_sole` – the swing sole at a progress
    pub(crate) fn begin_half_step(&mut self, half_duration: f64, swing_sole: impl Fn(f64) -> SolePose) {
        self.lowered_at_end += self.redirected.1;
        self.redirected = (0.0, 0.0);
        self.lowered_at_support_change = self.lowered_at_end;
        self.lowered_at_start = self.lowered_at_end;
        self.lowered_at_end = self.needed_to_land(half_duration, swing_sole);
    }

    /// Lands elsewhere, from a progress on.
    ///
    /// * `half_duration`, `swing_sole` – as in [`begin_half_step`](Self::begin_half_step)
    pub(crate) fn redirect(&mut self, from: f64, half_duration: f64, swing_sole: impl Fn(f64) -> SolePose) {
        self.redirected = (from, self.needed_to_land(half_duration, swing_sole) - self.lowered_at_end);
    }

    /// The lowering that lets the swing leg reach late in its swing (m).
    fn needed_to_land(&self, half_duration: f64, swing_sole: impl Fn(f64) -> SolePose) -> f64 {
        let width = Vector2::new(0.0, self.hip_width);
        let middle = (swing_sole(1.0).position.xy() - width) / 2.0;
        let lowered = LATE_SWING.map(|progress| {
            // The pendulum of a steady walk (Kajita 2001): slow walks stay long over the support foot.
            let passed = sinh(half_duration * (2.0 * progress - 1.0)) / sinh(half_duration);
            let reach = swing_sole(progress).position.xy() - width - middle * passed;
            self.needed(reach.norm() + self.hip_offset_max)
        });
        lowered.into_iter().fold(0.0, f64::max)
    }

    /// Crouches for a start from a stand: the pelvis moves over the support foot while the other one is still on the
    /// ground. The crouch is complete at half of the weight shift.
    ///
    /// * `other_foot` – where the other foot stands
    /// * `weight_shift_progress` – progress of the weight shift, 0 to 1
    pub(crate) fn crouch(&mut self, other_foot: &SolePose, weight_shift_progress: f64) {
        let spread = other_foot.position.xy() - Vector2::new(0.0, self.hip_width);
        let needed = self.needed(spread.norm() + self.hip_offset_max).max(self.lowered_at_support_change);
        let done = smooth_step((2.0 * weight_shift_progress).min(1.0));
        self.lowered_at_start = self.lowered_at_support_change + (needed - self.lowered_at_support_change) * done;
    }

    /// The lowering that lets a leg reach a horizontal distance from its hip (m).
    fn needed(&self, reach: f64) -> f64 {
        (self.above_ankle - (self.leg_length_max * self.leg_length_max - reach * reach).max(0.0).sqrt()).max(0.0)
    }

    /// How much lower than the nominal the hips are at a progress (m).
    pub(crate) fn lowered(&self, progress: f64) -> f64 {
        let planned = self.lowered_at_start + (self.lowered_at_end - self.lowered_at_start) * smooth_step(progress);
        let (from, more) = self.redirected;
        if more == 0.0 { planned } else { planned + more * smooth_step(((progress - from) / (1.0 - from)).max(0.0)) }
    }
}

/// `sinh` to 1 % up to 2. It calls no mathematical library of the system, which would round differently elsewhere.
fn sinh(x: f64) -> f64 {
    let square = x * x;
    x * (1.0 + square / 6.0 * (1.0 + square / 20.0 * (1.0 + square / 42.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sinh_series_is_accurate_to_one_percent() {
        for x in [-2.0_f64, -0.5, 0.1, 1.0, 2.0] {
            assert!((sinh(x) / x.sinh() - 1.0).abs() < 0.01, "sinh({x}) = {}", sinh(x));
        }
    }
}
