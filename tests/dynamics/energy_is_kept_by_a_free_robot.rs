//! A robot that floats in free fall, unforced and tumbling, keeps its energy, and its centre of mass falls as a stone.
//!
//! Method: explicit midpoint with a small step; what remains of an energy error must shrink with the square of the
//! step.

use dynamics::{ArticulatedBody, Kinematics, Tree, kinetic_energy, potential_energy};
use halfstep_tests::{mechanism, random, random_joints};
use model::{Joint, JointVector};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

#[derive(Clone)]
struct State {
    pose: Isometry3<f64>,
    angular_rate: Vector3<f64>,
    velocity: Vector3<f64>,
    angles: JointVector,
    rates: JointVector,
}

impl State {
    /// Moves on by `step` with the rates of `at` and the accelerations found there.
    fn advanced(&self, at: &State, body: &mut ArticulatedBody, tree: &Tree, step: f64) -> State {
        body.set_state(tree, &at.pose, at.angular_rate, at.velocity, &at.angles, &at.rates);
        let accelerations = body.accelerations(tree, &JointVector::ZERO, &JointVector::ZERO, &[]);
        State {
            pose: Isometry3::from_parts(
                (self.pose.translation.vector + at.velocity * step).into(),
                UnitQuaternion::from_scaled_axis(at.angular_rate * step) * self.pose.rotation,
            ),
            angular_rate: self.angular_rate + accelerations.base_angular * step,
            velocity: self.velocity + accelerations.base_linear * step,
            angles: self.angles + at.rates * step,
            rates: self.rates + accelerations.joints * step,
        }
    }

    fn energy(&self, tree: &Tree) -> f64 {
        let mut kinematics = Kinematics::default();
        kinematics.compute_floating_base(tree, &self.pose, &self.angles);
        kinetic_energy(tree, &kinematics, self.angular_rate, self.velocity, &self.rates)
            + potential_energy(tree, &kinematics)
    }
}

fn energy_error(step: f64) -> f64 {
    let tree = Tree::new(&mechanism());
    let mut random = random(7);
    let mut rates = random_joints(&mut random, 2.0);
    let mut angles = random_joints(&mut random, 0.5);
    for joint in [Joint::FootRoll, Joint::FootPitch] {
        rates[joint] = 0.0;
        angles[joint] = 0.0;
    }
    let mut state = State {
        pose: Isometry3::translation(0.0, 0.0, 1.0),
        angular_rate: Vector3::new(0.5, -1.0, 0.3),
        velocity: Vector3::new(0.4, 0.2, 1.5),
        angles,
        rates,
    };
    let mut body = ArticulatedBody::default();
    let before = state.energy(&tree);
    for _ in 0..(0.2 / step).round() as usize {
        let middle = state.advanced(&state, &mut body, &tree, 0.5 * step);
        state = state.advanced(&middle, &mut body, &tree, step);
    }
    (state.energy(&tree) - before).abs()
}

#[test]
fn energy_error_of_a_free_robot_shrinks_with_the_square_of_the_step() {
    let coarse = energy_error(2e-4);
    let fine = energy_error(1e-4);
    assert!(fine < 2e-3, "energy changed by {fine} J of several hundred");
    assert!((3.0..6.0).contains(&(coarse / fine)), "halving the step changed {coarse} J to {fine} J: not second order");
}
