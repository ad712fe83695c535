//! Landing compliance: a leg yields to ground that comes early and reaches for ground that comes late.
//!
//! Each foot's height under the pelvis yields to an unexpected force like a damper (foot force control of Kajita et al.
//! 2010, "Biped walking stabilization based on linear inverted pendulum tracking", section IV), and returns to the
//! planned height while the robot walks on. Expected forces change nothing.

use dynamics::{Kinematics, LegSolver, Tree};
use model::{JointVector, Mechanism, Mirror, Mirrored, Motion, Side};
use nalgebra::{Isometry3, Translation3};

use crate::proportions::StabilizerProportions;

/// The offsets of both feet from their planned heights, and of the joints that realise them.
#[derive(Clone, Debug)]
pub struct LandingCompliance {
    parameters: LandingParameters,
    legs: LegSolver,
    proportions: StabilizerProportions,
    /// Height of the support and of the swing foot over the planned one, under the pelvis (m).
    lifts: [f64; 2],
    /// Angles and rates of the offsets, in support coordinates.
    offsets: Motion,
}

/// Parameters of [`LandingCompliance`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LandingParameters {
    /// Unexpected force over the speed with which the leg yields to it (N·s/m).
    pub damping: f64,
    /// Time constant with which the foot returns to its planned height (s).
    pub return_time: f64,
}

/// Least expected share of the weight on the support foot.
const SUPPORT_SHARE_MIN: f64 = 0.4;
/// Largest expected share of the weight on the swing foot.
const SWING_SHARE_MAX: f64 = 0.05;
/// Offsets below it are not realised, which saves the inverse kinematics (m).
const LIFT_MIN: f64 = 1e-6;

impl LandingCompliance {
    /// Both feet at their planned heights.
    pub fn new(mechanism: &Mechanism, parameters: LandingParameters) -> Self {
        Self {
            parameters,
            legs: LegSolver::new(mechanism),
            proportions: StabilizerProportions::of(mechanism),
            lifts: [0.0; 2],
            offsets: Motion::default(),
        }
    }

    /// Lets the feet yield to their loads.
    ///
    /// * `loads` – vertical force on the support and on the swing foot (N); `None` if unknown, or if the legs must not
    ///   yield
    /// * `dt` – time since the last update (s)
    pub fn update(&mut self, loads: Option<[f64; 2]>, dt: f64) {
        let StabilizerProportions { weight, landing_lift_max, .. } = self.proportions;
        let [support, swing] = loads.map_or([1.0, 0.0], |loads| loads.map(|load| load / weight));
        let unexpected = [(support - SUPPORT_SHARE_MIN).min(0.0), (swing - SWING_SHARE_MAX).max(0.0)];
        for (lift, share) in self.lifts.iter_mut().zip(unexpected) {
            let yielding = share * weight / self.parameters.damping;
            *lift = (*lift + yielding * dt) / (1.0 + dt / self.parameters.return_time);
            *lift = lift.clamp(-landing_lift_max, landing_lift_max);
        }
    }

    /// Advances the offsets of the joints by `dt` (s). A leg that would be too short keeps its offsets.
    ///
    /// * `planned` – planned joint angles, in support coordinates (rad)
    /// * `kinematics` – of these angles
    pub fn advance(&mut self, tree: &Tree, kinematics: &Kinematics, planned: &JointVector, dt: f64) {
        let before = self.offsets.angles;
        let angles = self.offsets_for(tree, kinematics, planned).unwrap_or(before);
        self.offsets = Motion { angles, rates: (angles - before) * (1.0 / dt), ..Motion::default() };
    }

    /// The offsets that realise the lifts; `None` when a leg would be too short.
    fn offsets_for(&self, tree: &Tree, kinematics: &Kinematics, planned: &JointVector) -> Option<JointVector> {
        if self.lifts.iter().all(|lift| lift.abs() < LIFT_MIN) {
            return Some(JointVector::ZERO);
        }
        let pelvis = kinematics.link_to_world(tree.pelvis());
        let feet = Side::BOTH.map(|side| kinematics.link_to_world(tree.foot(side)));
        let raised = |foot: &Isometry3<f64>, lift: f64| Translation3::new(0.0, 0.0, lift) * foot;
        let mut angles = *planned;
        for (side, lift) in Side::BOTH.into_iter().zip(self.lifts) {
            let foot = raised(&feet[side.index()], lift);
            self.legs.solve(side, &pelvis, &foot, &mut angles).ok()?;
        }
        Some(angles - *planned)
    }

    /// Expresses everything in support coordinates of the other foot, which supports from now on.
    pub fn change_support(&mut self, mirror: &Mirror) {
        self.lifts.reverse();
        self.offsets = self.offsets.mirrored(mirror);
    }

    /// The offsets of the joints at present: angles with their rates, in support coordinates.
    pub fn offsets(&self) -> &Motion {
        &self.offsets
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use config::Config;

    const PARAMETERS: LandingParameters = LandingParameters { damping: 300.0, return_time: 0.5 };

    fn mechanism() -> Mechanism {
        Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap()
    }

    /// A walking posture (rad).
    fn angles() -> JointVector {
        use model::Joint::*;
        let mut angles = JointVector::ZERO;
        for (joint, angle) in [(RightAnklePitch, 0.3), (RightKnee, -0.6), (RightHipPitch, 0.3)] {
            angles[joint] = angle;
        }
        for (joint, angle) in [(LeftHipPitch, -0.4), (LeftKnee, 0.7), (LeftAnklePitch, -0.3)] {
            angles[joint] = angle;
        }
        angles
    }

    /// The oracle: a spring under the swing foot stands for ground that comes early; the leg yields until hardly any
    /// force is left.
    #[test]
    fn leg_yields_to_ground_that_comes_early_by_lifting_the_level_sole() {
        let mechanism = mechanism();
        let tree = Tree::new(&mechanism);
        let mut compliance = LandingCompliance::new(&mechanism, PARAMETERS);
        let (angles, early) = (angles(), 0.01);
        let kinematics = Kinematics::fixed_base(&tree, &angles);
        for _ in 0..200 {
            let force = 1e5 * (early - compliance.lifts[1]).max(0.0);
            compliance.update(Some([700.0, force]), 1e-3);
            compliance.advance(&tree, &kinematics, &angles, 1e-3);
        }
        let raised = Kinematics::fixed_base(&tree, &(angles + compliance.offsets().angles));
        let sole = |kinematics: &Kinematics| kinematics.sole_to_world(&mechanism, Side::Left);
        let way = sole(&raised).translation.vector - sole(&kinematics).translation.vector;
        assert!((way.z - early).abs() < 2e-3, "the sole is raised by {} m", way.z);
        assert!(way.xy().norm() < 1e-9, "and nothing else: {way}");
        assert!(sole(&raised).rotation.angle_to(&sole(&kinematics).rotation) < 1e-9);
    }

    #[test]
    fn leg_reaches_for_ground_that_comes_late_and_returns() {
        let mut compliance = LandingCompliance::new(&mechanism(), PARAMETERS);
        for _ in 0..10 {
            compliance.update(Some([0.0, 0.0]), 1e-3);
        }
        let reached = compliance.lifts[0];
        assert!((-0.02..-0.005).contains(&reached), "{reached} m in a hundredth of a second");
        for _ in 0..500 {
            compliance.update(Some([715.0, 0.0]), 1e-3);
        }
        assert!((compliance.lifts[0] / reached - (-1.0_f64).exp()).abs() < 1e-3);
    }

    #[test]
    fn expected_loads_leave_the_feet_at_their_planned_heights() {
        let mut compliance = LandingCompliance::new(&mechanism(), PARAMETERS);
        for load in [500.0, 716.0, 900.0] {
            compliance.update(Some([load, 20.0]), 1e-3);
        }
        compliance.update(None, 1e-3);
        assert_eq!(compliance.lifts, [0.0; 2]);
    }
}
