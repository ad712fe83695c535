//! Whole-body inverse kinematics: the joint angles that put centre of mass, pelvis and feet where a task demands.

use dynamics::{Kinematics, Unreachable, UpperBody};
use model::{Joint, JointVector, Mirrored, Side};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector2, Vector3};

use crate::footprint::{SolePose, rotation_about_z};
use crate::pattern_model::PatternModel;

/// The task that a posture fulfils, in support coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WholeBodyTask {
    /// Projection of the centre of mass (m).
    pub com: Vector2<f64>,
    /// Height of the pelvis link's origin (m).
    pub hip_height: f64,
    /// Heading of the pelvis, which is level (rad).
    pub pelvis_yaw: f64,
    /// The swing sole.
    pub swing_sole: SolePose,
    /// Angles of waist and arms (rad); those of the legs are not used.
    pub upper: JointVector,
    /// Waist and arms as the load that the pelvis carries.
    pub carried: UpperBody,
}

/// The solver. Each solution starts from the one before.
#[derive(Clone, Debug)]
pub(crate) struct WholeBodyIk {
    /// The last solution (rad).
    angles: JointVector,
    kinematics: Kinematics,
    /// Change of the angles from the solution before: the next change is likely the same.
    change: JointVector,
    /// Origin of the pelvis (the support leg's hip) less the centre of mass, in the last solution (m).
    hip_from_com: Vector2<f64>,
    /// The last two changes of that (m).
    hip_changes: [Vector2<f64>; 2],
}

/// Rounds of correcting the pelvis at most; two are usual.
const ROUNDS_MAX: usize = 6;
/// Error of the centre of mass at which one more correction is enough (m). A correction leaves about 3 % of an error,
/// and 1 µm in a knot is a millimetre of ZMP.
const COM_ERROR_NEAR: f64 = 1e-5;

impl WholeBodyIk {
    /// Starts from a posture in support coordinates.
    pub(crate) fn new(model: &PatternModel, angles: &JointVector) -> Self {
        let kinematics = Kinematics::fixed_base(&model.tree, angles);
        let hip_from_com = kinematics.origin[model.tree.pelvis()].xy() - kinematics.com(&model.tree).xy();
        Self {
            angles: *angles,
            kinematics,
            change: JointVector::ZERO,
            hip_from_com,
            hip_changes: [Vector2::zeros(); 2],
        }
    }

    /// Sets the expected change of the angles to the next solution (rad).
    pub(crate) fn expect_change(&mut self, change: &JointVector) {
        self.change = *change;
    }

    /// The joint angles that fulfil a task (rad).
    ///
    /// # Errors
    /// [`Unreachable`] when a leg is too short; the last solution stays.
    pub(crate) fn solve(&mut self, model: &PatternModel, task: &WholeBodyTask) -> Result<JointVector, Unreachable> {
        let PatternModel { tree, mechanism, legs, .. } = model;
        let mut angles = self.angles + self.change;
        for joint in Joint::ALL.into_iter().filter(|joint| !joint.is_in_leg()) {
            angles[joint] = task.upper[joint];
        }
        let ankle = Translation3::from(-mechanism.sole_in_foot(Side::Left));
        let foot = task.swing_sole.to_support() * ankle;
        let heading = rotation_about_z(task.pelvis_yaw);

        let [change, before] = self.hip_changes;
        let mut hip = task.com + self.hip_from_com + change * 2.0 - before;
        let hip_height = within_reach(model, task.hip_height, hip, &heading, &foot);
        let mut is_near = false;
        for _ in 0..ROUNDS_MAX {
            let pelvis = Isometry3::from_parts(Translation3::new(hip.x, hip.y, hip_height), heading);
            legs.solve(Side::Right, &pelvis, &Isometry3::identity(), &mut angles)?;
            legs.solve(Side::Left, &pelvis, &foot, &mut angles)?;
            if is_near {
                break;
            }
            self.kinematics.compute_legs(tree, &angles);
            let error = task.com - self.kinematics.com_with(tree, &task.carried).xy();
            hip += error / model.com_per_pelvis;
            is_near = error.amax() < COM_ERROR_NEAR;
        }
        self.change = angles - self.angles;
        let hip_from_com = hip - task.com;
        self.hip_changes = [hip_from_com - self.hip_from_com, change];
        self.hip_from_com = hip_from_com;
        self.angles = angles;
        Ok(angles)
    }

    /// Expresses the last solution in support coordinates of the other foot, which supports from now on.
    pub(crate) fn change_support(&mut self, model: &PatternModel) {
        let change = self.change.mirrored(&model.mirror);
        *self = Self { change, ..Self::new(model, &self.angles.mirrored(&model.mirror)) };
    }
}

/// The height of the pelvis, lowered where a leg would be too short (m).
///
/// * `pelvis` – origin of the pelvis link
/// * `heading` – of the pelvis
/// * `swing_foot` – pose of the other foot
fn within_reach(
    model: &PatternModel,
    height: f64,
    pelvis: Vector2<f64>,
    heading: &UnitQuaternion<f64>,
    swing_foot: &Isometry3<f64>,
) -> f64 {
    let (leg_max, rounding) = (model.proportions.leg_length_max, model.proportions.leg_limit_rounding);
    let reach = |side: Side, ankle: &Vector3<f64>| {
        let hip = heading * model.reach.hips_in_pelvis[side.index()];
        let apart = pelvis + hip.xy() - ankle.xy();
        ankle.z + (leg_max * leg_max - apart.norm_squared()).max(0.0).sqrt() - hip.z
    };
    let [support_ankle, swing_ankle] = model.reach.ankles_in_foot;
    let swing_ankle = swing_foot.translation.vector + swing_foot.rotation * swing_ankle;
    let over_support = soft_min(height, reach(Side::Right, &support_ankle), rounding);
    soft_min(over_support, reach(Side::Left, &swing_ankle), rounding)
}

/// The smaller of two lengths (m), twice continuously differentiable: rounded where they differ by less than
/// `rounding`.
fn soft_min(a: f64, b: f64, rounding: f64) -> f64 {
    let near = (1.0 - (a - b).abs() / rounding).max(0.0);
    a.min(b) - near * near * near * rounding / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn soft_min_is_the_minimum_away_from_equality_and_below_it_near() {
        assert_eq!(soft_min(0.8, 0.9, 0.015), 0.8);
        assert_eq!(soft_min(0.9, 0.8, 0.015), 0.8);
        assert!((soft_min(0.8, 0.8, 0.015) - (0.8 - 0.0025)).abs() < 1e-15);
    }

    #[test]
    fn soft_min_is_continuously_differentiable() {
        let slope = |a: f64| (soft_min(a + 1e-7, 0.8, 0.015) - soft_min(a - 1e-7, 0.8, 0.015)) / 2e-7;
        for a in [0.785, 0.8, 0.815] {
            assert!(
                (slope(a + 1e-6) - slope(a - 1e-6)).abs() < 1e-3,
                "at {a}: {} and {}",
                slope(a - 1e-6),
                slope(a + 1e-6)
            );
        }
    }
}
