//! At rest the ground must carry the weight at the projection of the centre of mass, in any posture.

use dynamics::{NewtonEuler, Tree, zmp};
use halfstep_tests::{mechanism, random, random_joints};
use model::{GRAVITY, Joint, Motion};

#[test]
fn a_resting_robots_zmp_is_under_its_centre_of_mass_in_random_postures() {
    let mechanism = mechanism();
    let tree = Tree::new(&mechanism);
    let mut random = random(4);
    let mut inverse = NewtonEuler::default();
    for _ in 0..100 {
        inverse.compute_fixed_base(&tree, &Motion::at_rest(random_joints(&mut random, 1.0)));
        let com = inverse.kinematics.com(&tree);
        let point = zmp(&inverse.ground).expect("the ground carries the robot");
        assert!((point - com.xy()).amax() < 1e-12);
        assert!((inverse.ground.force.z - mechanism.mass() * GRAVITY).abs() < 1e-9);
        assert!(inverse.ground.force.xy().amax() < 1e-9);
    }
}

/// The unpowered joints' torques are the ground moment about the floor under the ankle.
#[test]
fn unpowered_contact_joints_carry_the_ground_moment() {
    let tree = Tree::new(&mechanism());
    let mut random = random(5);
    let mut inverse = NewtonEuler::default();
    let mut motion = halfstep_tests::random_motion(&mut random);
    motion.angles[Joint::FootRoll] = 0.0;
    inverse.compute_fixed_base(&tree, &motion);
    assert!((inverse.torques[Joint::FootRoll] - inverse.ground.moment.x).abs() < 1e-9);
    assert!((inverse.torques[Joint::FootPitch] - inverse.ground.moment.y).abs() < 1e-9);
}
