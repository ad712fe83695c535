//! Checks given footsteps before any simulation: right and left take turns, and each is within the range of steps.

use dynamics::poses_in_frame_of;
use interface::{Footstep, WalkPose};

use crate::footprint::Footprint;
use crate::footstep_plan::FootstepPlan;
use crate::pattern_model::PatternModel;

/// A footstep that cannot be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootstepFault {
    /// Which one, counted from 0.
    pub index: usize,
    /// Why not.
    pub problem: FootstepProblem,
}

/// Why a footstep cannot be made. A value that is out of range comes with its bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FootstepProblem {
    /// It is of the same foot as the one before.
    SameFoot,
    /// It is too far ahead of the other foot, behind it or beside it (m).
    TooFar([f64; 2]),
    /// It is on the wrong side of the other foot, or on it: distance to that foot's side (m).
    Crosses([f64; 2]),
    /// The foot would be turned too far against the other one (rad).
    Turned([f64; 2]),
}

/// Checks footsteps that are to follow the present ones.
///
/// * `frame` – of the footsteps, in the walk frame
///
/// # Errors
/// The first one that cannot be made.
pub(crate) fn check_footsteps(
    model: &PatternModel,
    plan: &FootstepPlan,
    footsteps: &[Footstep],
    frame: &WalkPose,
) -> Result<(), FootstepFault> {
    let feet = &plan.feet;
    let landed = feet.footprint.next(&feet.landing);
    let [mut support, other] = if plan.gait_state.is_standing() {
        [feet.footprint, feet.footprint.next(&feet.lift_off)]
    } else {
        [landed, feet.footprint]
    };
    if footsteps.first().is_some_and(|first| first.side == support.side) {
        // The other one steps in place first.
        support = other;
    }
    for (index, footstep) in footsteps.iter().enumerate() {
        let fault = |problem| FootstepFault { index, problem };
        if footstep.side == support.side {
            return Err(fault(FootstepProblem::SameFoot));
        }
        let [sole] = poses_in_frame_of(frame, &[footstep.sole]);
        check_step(model, plan, &support, &sole).map_err(fault)?;
        support = support.next(&support.sole_at(&sole));
    }
    Ok(())
}

/// Checks one step of the other foot.
fn check_step(
    model: &PatternModel,
    plan: &FootstepPlan,
    support: &Footprint,
    sole: &WalkPose,
) -> Result<(), FootstepProblem> {
    let (geometry, limits) = (model.velocity.geometry(), plan.walk.limits());
    let landing = support.sole_at(sole);
    let (x, y) = (landing.position.x, landing.position.y);
    let (ahead, back) = (geometry.step(0.5 * limits.extension_max), geometry.step(0.5 * limits.extension_min).min(0.0));
    if x != x.clamp(back, ahead) {
        return Err(FootstepProblem::TooFar([x, x.clamp(back, ahead)]));
    }
    let aside = geometry.width + geometry.aside(0.5 * limits.sidestep_max, 0.0);
    if y > aside {
        return Err(FootstepProblem::TooFar([y, aside]));
    }
    // Whatever their headings, soles that are nearer overlap unless one is ahead of the other.
    if y <= 0.0 {
        return Err(FootstepProblem::Crosses([y, 0.0]));
    }
    if landing.yaw.abs() > limits.turn_max {
        return Err(FootstepProblem::Turned([landing.yaw, limits.turn_max.copysign(landing.yaw)]));
    }
    Ok(())
}
