//! The accelerations that Newton–Euler was asked about come back from the articulated bodies, given its torques and
//! wrench.

use dynamics::{ArticulatedBody, BaseMotion, LinkLoad, NewtonEuler, Tree};
use halfstep_tests::{mechanism, random, random_joints, random_motion, without_contact_joints};
use model::{Joint, JointVector, Mechanism};
use nalgebra::{Isometry3, Matrix6, Vector3};
use rand::{Rng, rngs::StdRng};

fn vector(random: &mut StdRng, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.random_range(-size..size))
}

#[test]
fn forward_dynamics_undoes_inverse_dynamics_of_a_floating_robot() {
    let tree = Tree::new(&mechanism());
    let mut random = random(1);
    let (mut inverse, mut forward) = (NewtonEuler::default(), ArticulatedBody::default());
    for _ in 0..200 {
        let motion = without_contact_joints(random_motion(&mut random));
        let base = BaseMotion {
            sole_to_world: Isometry3::new(vector(&mut random, 2.0), vector(&mut random, 2.0)),
            angular_rate: vector(&mut random, 2.0),
            velocity: vector(&mut random, 2.0),
            angular_acceleration: vector(&mut random, 10.0),
            acceleration: vector(&mut random, 10.0),
        };
        inverse.compute_floating_base(&tree, &base, &motion);

        forward.set_state(&tree, &base.sole_to_world, base.angular_rate, base.velocity, &motion.angles, &motion.rates);
        let on_foot = LinkLoad { link: Mechanism::RIGHT_FOOT, wrench: inverse.ground, added_inertia: Matrix6::zeros() };
        let found = forward.accelerations(&tree, &inverse.torques, &JointVector::ZERO, &[on_foot]);

        let joints = (found.joints - motion.accelerations).max_abs();
        assert!(joints < 1e-8, "joints differ by {joints} rad/s²");
        assert!((found.base_angular - base.angular_acceleration).amax() < 1e-8);
        assert!((found.base_linear - base.acceleration).amax() < 1e-8);
    }
}

/// A load that yields to the link's acceleration is the same as the lesser load that in the end acts.
#[test]
fn a_yielding_load_equals_the_smaller_load_that_remains() {
    let tree = Tree::new(&mechanism());
    let mut random = random(2);
    let mut body = ArticulatedBody::default();
    let angles = without_contact_joints(random_motion(&mut random)).angles;
    let torques = random_joints(&mut random, 30.0);
    let link = Joint::LeftAnkleRoll;
    let wrench = model::Wrench { force: vector(&mut random, 300.0), moment: vector(&mut random, 30.0) };
    let yielding = Matrix6::from_fn(|_, _| random.random_range(-1.0..1.0));
    let added_inertia = yielding * yielding.transpose();

    let pose = Isometry3::translation(0.3, 0.1, 0.0);
    body.set_state(&tree, &pose, Vector3::zeros(), Vector3::zeros(), &angles, &JointVector::ZERO);
    let yielded = body.accelerations(&tree, &torques, &JointVector::ZERO, &[LinkLoad { link, wrench, added_inertia }]);

    let lost = added_inertia * body.link_acceleration(link);
    let acted = wrench
        - model::Wrench { moment: lost.fixed_rows::<3>(0).into_owned(), force: lost.fixed_rows::<3>(3).into_owned() };
    let given = LinkLoad { link, wrench: acted, added_inertia: Matrix6::zeros() };
    let same = body.accelerations(&tree, &torques, &JointVector::ZERO, &[given]);
    let scale = yielded.joints.max_abs();
    let difference = (same.joints - yielded.joints).max_abs() / scale;
    assert!(difference < 1e-10, "joints differ by {difference} of {scale} rad/s²");
    assert!((same.base_linear - yielded.base_linear).amax() < 1e-10 * scale);
}
