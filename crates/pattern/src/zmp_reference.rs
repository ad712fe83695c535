//! The ZMP reference: where the zero-moment point of the cart-table model shall be at the coming knots.

use model::Side;
use nalgebra::Vector2;

use crate::footstep_plan::FootstepPlan;
use crate::pattern_model::{KNOTS_PREVIEWED, PatternModel};
use crate::preview_controller::PreviewController;

/// The reference of the ZMP at the coming knots: beside the support ankle, in the middle between the sole's sides, less
/// the part of the whole body's ZMP that the cart-table model leaves out. Computed anew when the footsteps change; else
/// one knot is added as one is used.
#[derive(Clone, Debug)]
pub(crate) struct ZmpReference {
    /// A ring of references in the walk frame (m); the next knot's is at `next`.
    zmps: [Vector2<f64>; KNOTS_PREVIEWED],
    next: usize,
    /// The footsteps at the last of these knots.
    footsteps: FootstepPlan,
}

impl ZmpReference {
    /// The reference for the knots that follow a footstep plan's present one.
    pub(crate) fn new(model: &PatternModel, footsteps: &FootstepPlan) -> Self {
        let mut reference = Self { zmps: [Vector2::zeros(); KNOTS_PREVIEWED], next: 0, footsteps: footsteps.clone() };
        reference.restart(model, footsteps);
        reference
    }

    /// Computes all of it anew, from the present knot of a footstep plan.
    pub(crate) fn restart(&mut self, model: &PatternModel, footsteps: &FootstepPlan) {
        self.footsteps.clone_from(footsteps);
        for _ in 0..self.zmps.len() {
            self.advance(model);
        }
    }

    /// Drops the reference of the next knot and adds one at the end.
    pub(crate) fn advance(&mut self, model: &PatternModel) {
        self.footsteps.advance(model);
        let FootstepPlan { gait_state, feet, .. } = &self.footsteps;
        let foot = feet.between(gait_state.support_weight_share(), model.mechanism.sole.centre(Side::Right).y);
        self.zmps[self.next] = feet.footprint.point_to_walk(foot - self.footsteps.lipm_residual(model));
        self.next = (self.next + 1) % self.zmps.len();
    }

    /// The sum of the references, each times its preview gain, along both axes of the walk frame.
    pub(crate) fn weighted_sum(&self, controller: &PreviewController) -> Vector2<f64> {
        controller.weighted_sum(&self.zmps, self.next)
    }
}
