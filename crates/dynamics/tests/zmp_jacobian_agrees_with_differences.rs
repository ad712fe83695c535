//! Goal: `ZmpJacobian` is the derivative of the ZMP by Newton–Euler, by every joint's angle, rate and acceleration,
//! joints 1 and 2 included.
//!
//! Method: random motions of both mechanisms. Central differences for all three; besides, each exact to rounding, facts
//! of physics: the wrench is linear in the accelerations, a resting robot's ZMP moves as its centre of mass does, and
//! along a motion the three add up to the ZMP's velocity.

use std::path::Path;

use config::Config;
use dynamics::{Kinematics, NewtonEuler, Tree, ZmpJacobian, zmp};
use model::{Joint, JointVector, Mechanism, Motion, PerJoint};
use nalgebra::Vector2;
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};

fn trees() -> [Tree; 2] {
    ["mechanism.toml", "mechanism_other_reading.toml"].map(|file| {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config").join(file);
        Tree::new(&Mechanism::load(&file).expect("the committed mechanism loads"))
    })
}

fn joints(random: &mut StdRng, size: f64) -> JointVector {
    PerJoint::from_fn(|_| random.random_range(-size..size))
}

/// Motions under which the ground carries at least a third of the weight, so that differences are small beside it.
fn motions(tree: &Tree, seed: u64, count: usize) -> Vec<Motion> {
    let mut random = StdRng::seed_from_u64(seed);
    let any = std::iter::repeat_with(|| Motion {
        angles: joints(&mut random, 0.8),
        rates: joints(&mut random, 2.0),
        accelerations: joints(&mut random, 10.0),
    });
    any.filter(|motion| force(tree, motion) > 3.0 * tree.mass).take(count).collect()
}

fn force(tree: &Tree, motion: &Motion) -> f64 {
    NewtonEuler::default().ground_wrench(tree, motion).force.z
}

fn zmp_of(tree: &Tree, motion: &Motion) -> Vector2<f64> {
    zmp(&NewtonEuler::default().ground_wrench(tree, motion)).expect("the ground pushes")
}

fn jacobian_of(tree: &Tree, motion: &Motion) -> ZmpJacobian {
    let mut jacobian = ZmpJacobian::default();
    assert_eq!(jacobian.compute_fixed_base(tree, motion), zmp(&jacobian.newton_euler.ground));
    jacobian
}

fn along(columns: &PerJoint<Vector2<f64>>, joints: &JointVector) -> Vector2<f64> {
    columns.iter().map(|(joint, column)| column * joints[joint]).sum()
}

#[track_caller]
fn assert_close(found: Vector2<f64>, expected: Vector2<f64>, within: f64, what: &str) {
    let apart = (found - expected).amax();
    assert!(apart <= within * (1.0 + expected.amax()), "{what}: {found:?} against {expected:?}");
}

#[test]
fn zmp_derivatives_by_every_joint_agree_with_differences() {
    const STEP: f64 = 1e-5;
    for tree in trees() {
        for motion in motions(&tree, 1, 50) {
            let jacobian = jacobian_of(&tree, &motion);
            for joint in Joint::ALL {
                let slope = |part: fn(&mut Motion) -> &mut JointVector| {
                    let moved = |step: f64| {
                        let mut moved = motion;
                        part(&mut moved)[joint] += step;
                        zmp_of(&tree, &moved)
                    };
                    (moved(STEP) - moved(-STEP)) / (2.0 * STEP)
                };
                let name = joint.name();
                assert_close(jacobian.by_angle[joint], slope(|motion| &mut motion.angles), 1e-7, name);
                assert_close(jacobian.by_rate[joint], slope(|motion| &mut motion.rates), 1e-7, name);
                assert_close(jacobian.by_acceleration[joint], slope(|motion| &mut motion.accelerations), 1e-7, name);
            }
        }
    }
}

/// The moment about one motion's ZMP that other accelerations bring is the change of the wrench, whatever its size.
#[test]
fn zmp_derivatives_by_acceleration_are_exact_for_large_differences() {
    for tree in trees() {
        for pair in motions(&tree, 2, 100).chunks(2) {
            let other = Motion { accelerations: pair[1].accelerations, ..pair[0] };
            if force(&tree, &other) <= 0.0 {
                continue;
            }
            let change = other.accelerations - pair[0].accelerations;
            let linear = along(&jacobian_of(&tree, &pair[0]).by_acceleration, &change);
            let apart = zmp_of(&tree, &other) - zmp_of(&tree, &pair[0]);
            let ratio = force(&tree, &other) / force(&tree, &pair[0]);
            assert_close(linear, apart * ratio, 1e-12, "other accelerations");
        }
    }
}

#[test]
fn the_zmp_at_rest_moves_as_the_centre_of_mass_does() {
    for tree in trees() {
        for motion in motions(&tree, 3, 50) {
            let jacobian = jacobian_of(&tree, &Motion::at_rest(motion.angles));
            let kinematics = Kinematics::fixed_base(&tree, &motion.angles);
            for joint in Joint::ALL {
                let (com, _) = kinematics.com_velocity(&tree, &JointVector::unit(joint));
                assert_close(jacobian.by_angle[joint], com.xy(), 1e-12, joint.name());
                assert_close(jacobian.by_rate[joint], Vector2::zeros(), 1e-12, joint.name());
            }
        }
    }
}

#[test]
fn zmp_derivatives_along_a_motion_add_up_to_the_velocity_of_the_zmp() {
    const STEP: f64 = 1e-5;
    for tree in trees() {
        let mut random = StdRng::seed_from_u64(4);
        for _ in 0..50 {
            let (size, phase) = (joints(&mut random, 0.3), joints(&mut random, 3.0));
            let frequency = PerJoint::from_fn(|_| random.random_range(1.0..5.0));
            // The n-th derivative of a sine is a quarter turn on for each.
            let derivative = |order: i32, time: f64| {
                PerJoint::from_fn(|joint: Joint| {
                    let turned =
                        frequency[joint] * time + phase[joint] + f64::from(order) * std::f64::consts::FRAC_PI_2;
                    size[joint] * frequency[joint].powi(order) * turned.sin()
                })
            };
            let at = |time| Motion {
                angles: derivative(0, time),
                rates: derivative(1, time),
                accelerations: derivative(2, time),
            };
            let jacobian = jacobian_of(&tree, &at(0.0));
            let velocity = along(&jacobian.by_angle, &derivative(1, 0.0))
                + along(&jacobian.by_rate, &derivative(2, 0.0))
                + along(&jacobian.by_acceleration, &derivative(3, 0.0));
            let difference = (zmp_of(&tree, &at(STEP)) - zmp_of(&tree, &at(-STEP))) / (2.0 * STEP);
            assert_close(velocity, difference, 1e-7, "velocity");
        }
    }
}

#[test]
fn there_is_no_zmp_jacobian_where_the_ground_would_have_to_pull() {
    let [tree, _] = trees();
    let mut random = StdRng::seed_from_u64(5);
    let mut jacobian = ZmpJacobian::default();
    let mut pulls = 0;
    for _ in 0..100 {
        let motion = Motion { accelerations: joints(&mut random, 200.0), ..Motion::default() };
        let found = jacobian.compute_fixed_base(&tree, &motion);
        assert_eq!(found.is_none(), jacobian.newton_euler.ground.force.z <= 0.0);
        pulls += usize::from(found.is_none());
    }
    let unknown = Motion { angles: JointVector::unit(Joint::WaistRoll) * f64::NAN, ..Motion::default() };
    assert_eq!(jacobian.compute_fixed_base(&tree, &unknown), None);
    assert!(pulls > 10, "{pulls} of 100 motions lift the robot: the case was hardly seen");
}
