//! The dynamics of robots whose legs have their joints in another order, whose axes are oblique and do not meet, whose
//! bodies have products of inertia, and that lack joints: each algorithm is the other's oracle.

use config::Config;
use dynamics::{ArticulatedBody, BaseMotion, Batch, Kinematics, LinkLoad, NewtonEuler, Tree, ZmpJacobian, mass_matrix};
use halfstep_tests::{random, random_motion, repository, without_contact_joints};
use model::{Joint, JointVector, Mechanism, Motion};
use nalgebra::{Isometry3, Matrix6, Vector3};
use rand::{Rng, rngs::StdRng};

/// The imported robots in the box.
fn robots() -> Vec<Mechanism> {
    let folder = repository().join("config/robots");
    let mut files: Vec<_> = std::fs::read_dir(folder).expect("it is committed").flatten().collect();
    files.sort_by_key(std::fs::DirEntry::file_name);
    let robots: Vec<Mechanism> = files
        .iter()
        .map(|entry| Mechanism::load(entry.path().join("mechanism.toml")).unwrap_or_else(|errors| panic!("{errors}")))
        .collect();
    assert!(robots.len() >= 9);
    robots
}

fn vector(random: &mut StdRng, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.random_range(-size..size))
}

/// A motion of the joints that the robot has.
fn motion_of(robot: &Mechanism, random: &mut StdRng) -> Motion {
    let mut motion = without_contact_joints(random_motion(random));
    for joint in Joint::ALL.into_iter().filter(|joint| !robot.has(*joint)) {
        (motion.angles[joint], motion.rates[joint], motion.accelerations[joint]) = (0.0, 0.0, 0.0);
    }
    motion
}

#[test]
fn forward_dynamics_undoes_inverse_dynamics_of_every_robot() {
    let mut random = random(3);
    for robot in robots() {
        let tree = Tree::new(&robot);
        let (mut inverse, mut forward) = (NewtonEuler::default(), ArticulatedBody::default());
        for _ in 0..30 {
            let motion = motion_of(&robot, &mut random);
            let base = BaseMotion {
                sole_to_world: Isometry3::new(vector(&mut random, 2.0), vector(&mut random, 2.0)),
                angular_rate: vector(&mut random, 2.0),
                velocity: vector(&mut random, 2.0),
                angular_acceleration: vector(&mut random, 10.0),
                acceleration: vector(&mut random, 10.0),
            };
            inverse.compute_floating_base(&tree, &base, &motion);
            let (rate, velocity) = (base.angular_rate, base.velocity);
            forward.set_state(&tree, &base.sole_to_world, rate, velocity, &motion.angles, &motion.rates);
            let (link, wrench) = (Mechanism::RIGHT_FOOT, inverse.ground);
            let on_foot = LinkLoad { link, wrench, added_inertia: Matrix6::zeros() };
            let found = forward.accelerations(&tree, &inverse.torques, &JointVector::ZERO, &[on_foot]);
            let off = (found.joints - motion.accelerations).max_abs();
            assert!(off < 1e-6, "{}: joints differ by {off} rad/s²", robot.name);
            assert!((found.base_angular - base.angular_acceleration).amax() < 1e-6, "{}", robot.name);
        }
    }
}

#[test]
fn mass_matrix_and_batch_agree_with_newton_euler_for_every_robot() {
    let mut random = random(4);
    for robot in robots() {
        let tree = Tree::new(&robot);
        let (mut newton_euler, mut batch) = (NewtonEuler::default(), Batch::default());
        let motion = motion_of(&robot, &mut random);
        let matrix = mass_matrix(&tree, &Kinematics::fixed_base(&tree, &motion.angles));
        let at_rest = Motion::at_rest(motion.angles);
        for joint in Joint::ALL {
            let accelerated = Motion { accelerations: JointVector::unit(joint), ..at_rest };
            newton_euler.compute_with_gravity(&tree, &accelerated, 0.0);
            for row in Joint::ALL {
                let off = (matrix[(row.index(), joint.index())] - newton_euler.torques[row]).abs();
                assert!(off < 1e-9, "{}: {} {}: {off}", robot.name, row.name(), joint.name());
            }
        }
        batch.set(0, &motion);
        batch.compute(&tree);
        let off = batch.ground(0) - newton_euler.ground_wrench(&tree, &motion);
        assert!(off.force.amax() < 1e-9 && off.moment.amax() < 1e-9, "{}: {off:?}", robot.name);
    }
}

/// The oracle: central differences.
#[test]
fn zmp_jacobian_agrees_with_differences_for_every_robot() {
    let mut random = random(5);
    for robot in robots() {
        let tree = Tree::new(&robot);
        let motion = motion_of(&robot, &mut random);
        let mut jacobian = ZmpJacobian::default();
        jacobian.moment_per_weight(&tree, &motion);
        let (by_angle, by_rate) = (jacobian.by_angle, jacobian.by_rate);
        let mut at = |motion: &Motion| jacobian.moment_per_weight(&tree, motion);
        for joint in Joint::ALL.into_iter().filter(|joint| robot.has(*joint)) {
            let step = JointVector::unit(joint) * 1e-5;
            let angle = [step, -step].map(|step| at(&Motion { angles: motion.angles + step, ..motion }));
            let rate = [step, -step].map(|step| at(&Motion { rates: motion.rates + step, ..motion }));
            let off = ((angle[0] - angle[1]) / 2e-5 - by_angle[joint]).amax();
            assert!(off < 1e-6, "{}: {} by angle: {off}", robot.name, joint.name());
            let off = ((rate[0] - rate[1]) / 2e-5 - by_rate[joint]).amax();
            assert!(off < 1e-6, "{}: {} by rate: {off}", robot.name, joint.name());
        }
    }
}
