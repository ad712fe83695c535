//! Touchdown: a leg gives way to ground that comes early and seeks ground that comes late.
//!
//! Each foot's height under the pelvis yields to the force that nobody expected of it, like a damper (Kajita et al. 2010,
//! "Biped walking stabilization based on linear inverted pendulum tracking", section IV), and comes back to what is planned
//! while the robot walks on. Forces as expected change nothing.

use dynamics::{Kinematics, Leg, LegSolver, Tree};
use model::{GRAVITY, JointVector, Mechanism, Mirror, Motion, Side};
use nalgebra::{Isometry3, Translation3};

use crate::LandingParameters;

/// How far either foot is off its planned height, and what that takes of the joints. The bearing foot comes first.
#[derive(Clone, Debug)]
pub struct Landing {
    parameters: LandingParameters,
    legs: LegSolver,
    /// Of the robot [N].
    weight: f64,
    /// Either foot over its planned height under the pelvis [m].
    lifts: [f64; 2],
    /// Angles and rates of the offsets, in support coordinates.
    offsets: Motion,
}

/// Shares of the weight that a walking robot's feet bear at least and at most.
const BEARING_MIN: f64 = 0.4;
const SWINGING_MAX: f64 = 0.05;
/// The legs give way or reach by this much at most [m].
const LIFT_MAX: f64 = 0.03;
/// What is less is nothing [m].
const LIFT_MIN: f64 = 1e-6;

impl Landing {
    /// Feet where they are planned.
    pub fn new(mechanism: &Mechanism, parameters: LandingParameters) -> Self {
        Self {
            parameters,
            legs: LegSolver::new(mechanism),
            weight: mechanism.mass() * GRAVITY,
            lifts: [0.0; 2],
            offsets: Motion::default(),
        }
    }

    /// Absorbs what the feet bear.
    ///
    /// * `loads` – vertical force on the bearing and on the swinging foot [N]; `None` if unknown, or if both may bear
    /// * `dt` – time since the last update [s]
    pub fn update(&mut self, loads: Option<[f64; 2]>, dt: f64) {
        let [bearing, swinging] = loads.map_or([1.0, 0.0], |loads| loads.map(|load| load / self.weight));
        let unexpected = [(bearing - BEARING_MIN).min(0.0), (swinging - SWINGING_MAX).max(0.0)];
        for (lift, share) in self.lifts.iter_mut().zip(unexpected) {
            let yielding = share * self.weight / self.parameters.damping;
            *lift = (*lift + yielding * dt) / (1.0 + dt / self.parameters.return_time);
            *lift = lift.clamp(-LIFT_MAX, LIFT_MAX);
        }
    }

    /// Moves the offsets on for a planned motion, told in support coordinates.
    ///
    /// * `kinematics` – of that motion
    pub fn advance(&mut self, tree: &Tree, kinematics: &Kinematics, planned: &JointVector, dt: f64) {
        let before = self.offsets.angles;
        let angles = self.offsets_for(tree, kinematics, planned).unwrap_or(before);
        self.offsets = Motion { angles, rates: (angles - before) * (1.0 / dt), ..Motion::default() };
    }

    /// `None` where a leg would be too short.
    fn offsets_for(&self, tree: &Tree, kinematics: &Kinematics, planned: &JointVector) -> Option<JointVector> {
        if self.lifts.iter().all(|lift| lift.abs() < LIFT_MIN) {
            return Some(JointVector::ZERO);
        }
        let pelvis = kinematics.link_to_world(Leg(Side::Right).end());
        let feet = Side::BOTH.map(|side| kinematics.link_to_world(Mechanism::foot(side)));
        let raised = |foot: &Isometry3<f64>, lift: f64| Translation3::new(0.0, 0.0, lift) * foot;
        let mut angles = *planned;
        for (side, lift) in Side::BOTH.into_iter().zip(self.lifts) {
            let foot = raised(&feet[side.index()], lift);
            self.legs.solve(tree, Leg(side), &pelvis, &foot, &mut angles).ok()?;
        }
        Some(angles - *planned)
    }

    /// The other foot bears.
    pub fn swap(&mut self, mirror: &Mirror) {
        self.lifts.reverse();
        self.offsets = self.offsets.mirrored(mirror);
    }

    /// What is added at present: angles with their rates, in support coordinates.
    pub fn offsets(&self) -> &Motion {
        &self.offsets
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARAMETERS: LandingParameters = LandingParameters { damping: 300.0, return_time: 0.5 };

    fn mechanism() -> Mechanism {
        Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap()
    }

    /// A walking posture.
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

    /// A spring under the swinging foot stands for ground that comes early: the leg yields until hardly anything presses.
    #[test]
    fn a_leg_gives_way_to_ground_that_comes_early_and_the_feet_are_where_that_leads() {
        let mechanism = mechanism();
        let tree = Tree::new(&mechanism);
        let mut landing = Landing::new(&mechanism, PARAMETERS);
        let (angles, early) = (angles(), 0.01);
        let kinematics = Kinematics::standing(&tree, &angles);
        for _ in 0..200 {
            let force = 1e5 * (early - landing.lifts[1]).max(0.0);
            landing.update(Some([700.0, force]), 1e-3);
            landing.advance(&tree, &kinematics, &angles, 1e-3);
        }
        let raised = Kinematics::standing(&tree, &(angles + landing.offsets().angles));
        let sole = |kinematics: &Kinematics| kinematics.sole_to_world(&mechanism, Side::Left);
        let way = sole(&raised).translation.vector - sole(&kinematics).translation.vector;
        assert!((way.z - early).abs() < 2e-3, "the sole is raised by {} m", way.z);
        assert!(way.xy().norm() < 1e-9, "and nothing else: {way}");
        assert!(sole(&raised).rotation.angle_to(&sole(&kinematics).rotation) < 1e-9);
    }

    #[test]
    fn a_leg_reaches_for_ground_that_comes_late_and_comes_back() {
        let mut landing = Landing::new(&mechanism(), PARAMETERS);
        for _ in 0..10 {
            landing.update(Some([0.0, 0.0]), 1e-3);
        }
        let reached = landing.lifts[0];
        assert!((-0.02..-0.005).contains(&reached), "{reached} m in a hundredth of a second");
        for _ in 0..500 {
            landing.update(Some([715.0, 0.0]), 1e-3);
        }
        assert!((landing.lifts[0] / reached - (-1.0_f64).exp()).abs() < 1e-3);
    }

    #[test]
    fn loads_as_expected_change_nothing() {
        let mut landing = Landing::new(&mechanism(), PARAMETERS);
        for load in [500.0, 716.0, 900.0] {
            landing.update(Some([load, 20.0]), 1e-3);
        }
        landing.update(None, 1e-3);
        assert_eq!(landing.lifts, [0.0; 2]);
    }
}
