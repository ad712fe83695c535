//! Sidestepping: the swing foot lands further aside by `γ` at the hips, as the paper turns and lengthens a step.
//!
//! Half of `γ` goes into either hip roll, joints 8 and 9, and the ankle rolls take it back so that the soles stay
//! level. One half-step deflects, the next restores: the foot on the side of the walk leads away, the other one follows
//! until the feet are as far apart as before. A full step moves the walk aside by about `2·l·sin(γ/2)` with legs of
//! length `l`, positive to the left. For an offset `g` of either leg, away from the other one, the support leg leans
//! outward as one goes up from the ground (ankle `−g`, hip `+g` about x), the swing leg as one goes down from the
//! pelvis (hip `+g`, ankle `−g`). Roll keeps its sign at the support change.

use model::{Joint, JointVector, Mechanism, Side};

use crate::{Deflection, RampKind, WalkError};

/// Hip roll and ankle joints of each leg.
const LEGS: [(Side, Joint, [Joint; 2]); 2] = [
    (Side::Right, Joint::RightHipRoll, [Joint::RightAnkleRoll, Joint::RightAnklePitch]),
    (Side::Left, Joint::LeftHipRoll, [Joint::LeftAnkleRoll, Joint::LeftAnklePitch]),
];

impl Deflection {
    /// No sidestep. Its angle is `γ`.
    pub fn sidestep(mechanism: &Mechanism, kind: RampKind) -> Self {
        let mut apart = JointVector::ZERO;
        let x = |joint: Joint| mechanism.links[joint].axis.x;
        for (_, hip, [one, other]) in LEGS {
            // Which of the two ankle joints rolls is data: the mechanism's axes decide, not the joint's name.
            let ankle = if x(one).abs() >= x(other).abs() { one } else { other };
            apart[hip] = x(hip).signum();
            apart[ankle] = -x(ankle).signum();
        }
        Self::new(apart, kind)
    }
}

/// Checks that offsets of the roll joints alone spread the legs and keep the soles level.
///
/// # Errors
/// [`WalkError::HipRollNotForward`] and [`WalkError::NoAnkleRoll`] when a leg has no such pair of joints about x.
pub(crate) fn check_joints(mechanism: &Mechanism) -> Result<(), WalkError> {
    let axis = |joint: Joint| mechanism.links[joint].axis.into_inner();
    let rolls = |joint: Joint| axis(joint).x.abs() > 1.0 - 1e-9;
    for (side, hip, ankle) in LEGS {
        if !rolls(hip) {
            return Err(WalkError::HipRollNotForward { joint: hip, axis: axis(hip) });
        }
        if !ankle.into_iter().any(rolls) {
            return Err(WalkError::NoAnkleRoll { side, ankle });
        }
    }
    Ok(())
}
