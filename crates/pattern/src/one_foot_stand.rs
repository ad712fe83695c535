//! Whether the robot can stand on one foot: then it may take its time to shift its weight onto it.

use dynamics::ReferenceDynamics;
use gait::Walk;
use model::{Joint, JointVector, Mechanism, Motion, Side};

use crate::foot_trajectory::FootTrajectory;
use crate::footstep_plan::FootstepPlan;
use crate::gait_state::Goal;
use crate::pattern_model::PatternModel;
use crate::weight_shift::WeightShift;
use crate::whole_body_ik::WholeBodyIk;

/// The model of a robot with the weight shift that suits it.
pub(crate) fn model_of(mechanism: &Mechanism, walk: &Walk) -> PatternModel {
    let model = PatternModel::new(mechanism, walk.mirror(), walk.table());
    if stands_on_one_foot(&model, walk) {
        return model;
    }
    PatternModel { weight_shift: WeightShift::by_swaying(walk.table().duration), ..model }
}

/// Whether no joint's range or torque is exceeded at rest with the centre of mass over the support foot, the other one
/// beside it.
fn stands_on_one_foot(model: &PatternModel, walk: &Walk) -> bool {
    let Some(posture) = posture(model, walk) else { return false };
    let mut dynamics = ReferenceDynamics::new(&model.mechanism, &model.tree, &model.mirror);
    dynamics.update(&model.tree, &model.mirror, &Motion::at_rest(posture), dynamics::PlannedContact::SupportFoot);
    Joint::ALL.into_iter().all(|joint| {
        let link = &model.mechanism.links[joint];
        let angle = posture[joint];
        let is_in_range = link.limits.is_none_or(|limits| (limits.angle_min..=limits.angle_max).contains(&angle));
        let is_held = link.motor.is_none_or(|motor| dynamics.torques[joint].abs() <= motor.torque_max());
        is_in_range && is_held
    })
}

/// The posture at the end of a weight shift that is so slow that nothing accelerates (rad), if the legs reach.
fn posture(model: &PatternModel, walk: &Walk) -> Option<JointVector> {
    let mut feet = FootTrajectory::new(model, FootstepPlan::standing(model, walk.clone()));
    let mut body = WholeBodyIk::new(model, &walk.table().angles_at(0.0));
    let aside = model.mechanism.sole.centre(Side::Right).y;
    feet.footsteps.set_goal(Goal::InPlace);
    let mut posture = None;
    while feet.footsteps.gait_state.is_standing() {
        let share = feet.footsteps.gait_state.support_weight_share();
        let feet_now = &feet.footsteps.feet;
        let com = feet_now.footprint.point_to_walk(feet_now.between(share, aside));
        posture = body.solve(model, &feet.task(model, com)).ok();
        feet.advance(model);
    }
    posture
}
