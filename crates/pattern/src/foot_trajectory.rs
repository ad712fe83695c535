//! The foot trajectory: what the half-steps demand of the body at a knot, apart from the centre of mass.

mod step_after_push;

use dynamics::{UpperBody, atan2};
use gait::Walk;
use model::JointVector;
use nalgebra::{Vector2, Vector3};

use crate::footstep_plan::{FootstepEvent, FootstepPlan};
use crate::gait_state::GaitState;
use crate::hip_height::HipHeight;
use crate::pattern_model::PatternModel;
use crate::step_adjustment::StepAdjustment;
use crate::swing_path::SwingPath;
use crate::whole_body_ik::WholeBodyTask;

pub use step_after_push::MeasuredBalance;

/// The footsteps at a knot, with the paths of the swing sole and of the hip height between them.
#[derive(Clone, Debug)]
pub(crate) struct FootTrajectory {
    /// Which half-steps come and where they put the feet.
    pub footsteps: FootstepPlan,
    swing: SwingPath,
    adjustment: StepAdjustment,
    hips: HipHeight,
}

/// The slowest walk that the limits of a gait can permit.
const SPEED_MIN: f64 = 0.05;
/// Progress until which a half-step can be changed: the foot has the rest of it to get elsewhere.
const REDIRECTED_UNTIL: f64 = 0.6;

impl FootTrajectory {
    /// The trajectory from the present knot of a footstep plan.
    pub(crate) fn new(model: &PatternModel, footsteps: FootstepPlan) -> Self {
        Self {
            swing: swing_path(model, &footsteps),
            adjustment: StepAdjustment::default(),
            hips: HipHeight::new(model, &footsteps.walk),
            footsteps,
        }
    }

    /// Advances by a knot. Returns whether the support foot changed.
    pub(crate) fn advance(&mut self, model: &PatternModel) -> bool {
        let Self { footsteps, swing, adjustment, hips } = self;
        let event = footsteps.advance(model);
        if event != FootstepEvent::None {
            *swing = swing_path(model, footsteps);
            *adjustment = StepAdjustment::default();
        }
        if event == FootstepEvent::SupportChange {
            let swing_sole = |progress| swing.at(progress, &footsteps.modified(model, progress));
            hips.begin_half_step(half_duration(model, &footsteps.walk), swing_sole);
        }
        if footsteps.gait_state.is_standing() {
            hips.crouch(&footsteps.feet.lift_off, footsteps.gait_state.weight_shift_progress());
        }
        event == FootstepEvent::SupportChange
    }

    /// Lets the present half-step change over to the command already, if there is time. Returns the half-step from
    /// which on all of it is in effect then.
    pub(crate) fn redirect(&mut self, model: &PatternModel) -> Option<u64> {
        let Self { footsteps, swing, adjustment, hips } = self;
        let progress = footsteps.walk.half_step().progress;
        if footsteps.gait_state != GaitState::Walking || progress > REDIRECTED_UNTIL || swing.is_redirected() {
            return None;
        }
        let effect_half_step = footsteps.redirect();
        let landing = footsteps.landing(model);
        let modified = |progress| footsteps.modified(model, progress);
        swing.redirect(progress, &landing, modified);
        let swing_sole = |progress| swing.at(progress, &modified(progress));
        hips.redirect(progress, half_duration(model, &footsteps.walk), swing_sole);
        let adjusted = adjustment.target();
        footsteps.feet.landing = landing;
        footsteps.feet.landing.position += Vector3::new(adjusted.x, adjusted.y, 0.0);
        Some(effect_half_step)
    }

    /// The task of the whole body at this knot.
    ///
    /// * `com` – projection of the centre of mass in the walk frame (m)
    pub(crate) fn task(&self, model: &PatternModel, com: Vector2<f64>) -> WholeBodyTask {
        let walk = &self.footsteps.walk;
        let progress = walk.half_step().progress;
        let nominal = walk.table().angles_at(progress);
        let modified = model.modified(walk, progress);
        let mut swing_sole = self.swing.at(progress, &modified);
        let [offset, ..] = self.adjustment.at(progress);
        swing_sole.position += Vector3::new(offset.x, offset.y, 0.0);
        WholeBodyTask {
            com: self.footsteps.feet.footprint.point_to_support(com),
            hip_height: modified.nominal_pelvis_height - self.hips.lowered(progress),
            pelvis_yaw: atan2(modified.pelvis.m21, modified.pelvis.m11),
            swing_sole,
            upper: nominal,
            carried: UpperBody::new(&model.tree, &nominal),
        }
    }

    /// Expresses angles of support coordinates in physical joints.
    pub(crate) fn to_physical(&self, model: &PatternModel, in_support: &JointVector) -> JointVector {
        model.mirror.to_physical(self.footsteps.feet.footprint.side, in_support)
    }

    /// Expresses angles of physical joints in support coordinates.
    pub(crate) fn to_support(&self, model: &PatternModel, physical: &JointVector) -> JointVector {
        model.mirror.to_support(self.footsteps.feet.footprint.side, physical)
    }

    /// Half-steps since the beginning of the walk, with the progress through the present one as fraction.
    pub(crate) fn phase(&self) -> f64 {
        let half_step = self.footsteps.walk.half_step();
        half_step.index as f64 + half_step.progress
    }

    /// The speed factor, 0 in a stand.
    pub(crate) fn speed(&self) -> f64 {
        if self.footsteps.gait_state.is_standing() { 0.0 } else { self.footsteps.walk.speed().state().value }
    }
}

/// Half the duration of a half-step times the rate of the pendulum (-).
fn half_duration(model: &PatternModel, walk: &Walk) -> f64 {
    let speed = walk.speed().target().min(walk.speed().state().value).max(SPEED_MIN);
    0.5 * walk.table().duration / speed / model.lipm_residual.height_over_gravity.sqrt()
}

fn swing_path(model: &PatternModel, footsteps: &FootstepPlan) -> SwingPath {
    let modified = |progress| footsteps.modified(model, progress);
    SwingPath::new(&footsteps.feet.lift_off, &footsteps.feet.landing, modified)
}
