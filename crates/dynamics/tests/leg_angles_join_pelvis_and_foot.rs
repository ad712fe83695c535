//! Goal: the angles of `LegSolver` bring pelvis and foot into the desired poses, for every structure of leg.
//!
//! Method: random angles give poses by forward kinematics; the angles found must give the same poses, and must be
//! Newton's. For poses out of reach the missing distance is reported.

use std::path::Path;

use config::Config;
use dynamics::{Kinematics, LegSolver, Tree, solve_leg};
use model::{Joint, JointVector, Mechanism, Side};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};

const POSTURES: usize = 10_000;

fn mechanism(file: &str) -> Mechanism {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config").join(file);
    Mechanism::load(&file).expect("the committed mechanism loads")
}

/// A random posture within the ranges; the two unpowered joints rotate the right foot as well.
fn posture(mechanism: &Mechanism, random: &mut StdRng) -> JointVector {
    JointVector::from_fn(|joint| match &mechanism.links[joint].limits {
        Some(limits) => random.random_range(limits.angle_min..limits.angle_max),
        None => random.random_range(-0.5..0.5),
    })
}

const fn knee(side: Side) -> Joint {
    match side {
        Side::Right => Joint::RightKnee,
        Side::Left => Joint::LeftKnee,
    }
}

fn feet_and_pelvis(tree: &Tree, angles: &JointVector) -> [Isometry3<f64>; 3] {
    let kinematics = Kinematics::fixed_base(tree, angles);
    [Mechanism::RIGHT_FOOT, tree.foot(Side::Left), tree.pelvis()].map(|link| kinematics.link_to_world(link))
}

/// Largest difference in position (m) or orientation (rad).
fn miss(one: &Isometry3<f64>, other: &Isometry3<f64>) -> f64 {
    let rotation = 2.0 * (one.rotation.inverse() * other.rotation).imag().amax();
    (one.translation.vector - other.translation.vector).amax().max(rotation)
}

/// Solves both legs of random postures and compares the poses that come out, and which way the knees bend.
fn random_postures_come_out(mechanism: &Mechanism, guess: impl Fn(&JointVector) -> JointVector) {
    let (tree, solver) = (Tree::new(mechanism), LegSolver::new(mechanism));
    let mut random = StdRng::seed_from_u64(4);
    for round in 0..POSTURES {
        let expected = posture(mechanism, &mut random);
        let poses = feet_and_pelvis(&tree, &expected);
        let mut angles = guess(&expected);
        for side in Side::BOTH {
            let reached = solver.solve(side, &poses[2], &poses[side.index()], &mut angles);
            assert_eq!(reached, Ok(()), "posture {round}, {side:?}: {expected:?}");
        }
        for (pose, found) in poses.iter().zip(feet_and_pelvis(&tree, &angles)) {
            let miss = miss(pose, &found);
            assert!(miss < 1e-12, "posture {round}: {miss:e} off: {expected:?}");
        }
    }
}

/// The posture without the angles of the legs, which the closed form must not read.
fn without_legs(expected: &JointVector) -> JointVector {
    JointVector::from_fn(|joint| if joint.is_in_leg() { f64::NAN } else { expected[joint] })
}

#[test]
fn closed_form_leg_angles_reach_ten_thousand_random_poses() {
    let mechanism = mechanism("mechanism.toml");
    assert!(LegSolver::new(&mechanism).is_closed_form());
    random_postures_come_out(&mechanism, without_legs);
}

#[test]
fn closed_form_reads_senses_of_axes_and_lengths_from_the_mechanism() {
    let mut mechanism = mechanism("mechanism.toml");
    let turned_round = [Joint::RightAnkleRoll, Joint::RightKnee, Joint::LeftHipYaw, Joint::LeftAnklePitch];
    for joint in turned_round {
        let link = &mut mechanism.links[joint];
        link.axis = -link.axis;
        let limits = link.limits.as_mut().expect("a powered joint");
        (limits.angle_min, limits.angle_max) = (-limits.angle_max, -limits.angle_min);
    }
    mechanism.links[Joint::RightKnee].origin.z = 0.38;
    mechanism.links[Joint::LeftKnee].origin.z = -0.45;
    mechanism.links[Joint::RightAnkleRoll].origin = Vector3::new(0.02, -0.01, 0.09);
    mechanism.links[Joint::LeftHipRoll].origin = Vector3::new(-0.01, 0.21, 0.03);
    assert!(LegSolver::new(&mechanism).is_closed_form());
    random_postures_come_out(&mechanism, without_legs);
}

#[test]
fn legs_of_another_structure_are_solved_by_iteration() {
    let other = mechanism("mechanism_other_reading.toml");
    assert!(!LegSolver::new(&other).is_closed_form());
    let (tree, solver) = (Tree::new(&other), LegSolver::new(&other));
    let mut random = StdRng::seed_from_u64(5);
    for _ in 0..1000 {
        // Knees well bent, or Newton may end in the mirrored leg.
        let mut expected = posture(&other, &mut random);
        let bend = random.random_range(0.3..1.2);
        (expected[Joint::RightKnee], expected[Joint::LeftKnee]) = (-bend, bend);
        let poses = feet_and_pelvis(&tree, &expected);
        let mut angles = expected.zip_with(&posture(&other, &mut random), |expected, other| expected + 0.02 * other);
        for side in Side::BOTH {
            solver.solve(side, &poses[2], &poses[side.index()], &mut angles).expect("within reach");
            for joint in tree.leg(side) {
                // The last step is not iterated further: see `leg_chain.rs`.
                assert!((angles[joint] - expected[joint]).abs() < 1e-6, "{joint:?} of {expected:?}");
            }
        }
    }

    for change in [
        |mechanism: &mut Mechanism| mechanism.links[Joint::LeftHipYaw].origin.x = 0.01,
        |mechanism: &mut Mechanism| mechanism.links[Joint::RightKnee].origin.y = 0.01,
        |mechanism: &mut Mechanism| mechanism.links[Joint::RightHipPitch].origin.z = -0.4,
    ] {
        let mut mechanism = mechanism("mechanism.toml");
        change(&mut mechanism);
        assert!(!LegSolver::new(&mechanism).is_closed_form());
    }
}

#[test]
fn closed_form_and_newtons_leg_angles_agree() {
    let mechanism = mechanism("mechanism.toml");
    let (tree, solver) = (Tree::new(&mechanism), LegSolver::new(&mechanism));
    let mut random = StdRng::seed_from_u64(6);
    for _ in 0..1000 {
        let mut expected = posture(&mechanism, &mut random);
        let bend = random.random_range(0.1..1.2);
        (expected[Joint::RightKnee], expected[Joint::LeftKnee]) = (-bend, bend);
        (expected[Joint::FootRoll], expected[Joint::FootPitch]) = (0.0, 0.0);
        let poses = feet_and_pelvis(&tree, &expected);
        let nearby = JointVector::from_fn(|joint| match mechanism.links[joint].limits {
            Some(_) => expected[joint] + random.random_range(-0.01..0.01),
            None => expected[joint],
        });
        let (mut newton, mut closed_form) = (nearby, nearby);
        solve_leg(&tree, Side::Right, &poses[2], &mut newton).expect("within reach");
        solve_leg(&tree, Side::Left, &poses[1], &mut newton).expect("within reach");
        for side in Side::BOTH {
            solver.solve(side, &poses[2], &poses[side.index()], &mut closed_form).expect("within reach");
        }
        for joint in Joint::ALL {
            let (one, other) = (closed_form[joint], newton[joint]);
            assert!((one - other).abs() < 1e-9, "{joint:?}: {one} against Newton's {other} in {expected:?}");
        }
    }
}

/// Pelvis level above the right foot, at this height of the hips over the ankles (m).
fn squat(mechanism: &Mechanism, height: f64) -> [Isometry3<f64>; 3] {
    let ankle = mechanism.sole.ankle_height;
    [Isometry3::identity(), Isometry3::translation(0.0, 0.19, ankle), Isometry3::translation(0.0, 0.0, ankle + height)]
}

#[test]
fn knees_bend_backward_and_continuously_from_stretched_to_folded() {
    let mechanism = mechanism("mechanism.toml");
    let solver = LegSolver::new(&mechanism);
    let mut before = [0.0; 2];
    for millimetres in (12..=856).rev() {
        let poses = squat(&mechanism, f64::from(millimetres) * 1e-3);
        let mut angles = JointVector::ZERO;
        for side in Side::BOTH {
            solver.solve(side, &poses[2], &poses[side.index()], &mut angles).expect("within reach");
            let bend = if side == Side::Right { -angles[knee(side)] } else { angles[knee(side)] };
            assert!(millimetres == 856 || bend > before[side.index()], "{side:?} at {millimetres} mm: {bend} rad");
            before[side.index()] = bend;
        }
    }
    for bend in before {
        assert!((bend - std::f64::consts::PI).abs() < 1e-6, "folded: {bend} rad");
    }
}

#[test]
fn a_leg_that_is_too_short_points_at_its_hip_and_the_missing_distance_is_reported() {
    let mechanism = mechanism("mechanism.toml");
    let (tree, solver) = (Tree::new(&mechanism), LegSolver::new(&mechanism));
    // The shank is 12 mm longer than the thigh, and together they are 856 mm long.
    for (height, missing) in [(0.9, 0.044), (5.0, 4.144), (0.856 + 1e-9, 1e-9), (0.01, 0.002), (0.0, 0.012)] {
        for side in Side::BOTH {
            let poses = squat(&mechanism, height);
            // The other leg stands at an arbitrary height.
            let mut angles = JointVector::ZERO;
            let reached = solver.solve(side, &poses[2], &poses[side.index()], &mut angles);
            let residual = reached.expect_err("out of reach").residual;
            assert!((residual - missing).abs() < 1e-12, "{side:?} at {height} m: {residual} m are missing");
            assert!(angles.is_finite(), "{side:?} at {height} m: {angles:?}");

            let [right, left, pelvis] = feet_and_pelvis(&tree, &angles);
            let foot = if side == Side::Right { right } else { left };
            let span = pelvis.inverse() * foot;
            let expected = poses[2].inverse() * poses[side.index()];
            let off = (span.translation.vector - expected.translation.vector).norm();
            assert!((off - missing).abs() < 1e-12, "{side:?} at {height} m: {off} m off");
            assert!(span.rotation.angle_to(&expected.rotation) < 1e-7);
        }
    }
}

#[test]
fn no_pose_leads_to_a_leg_angle_that_is_nan() {
    let mechanism = mechanism("mechanism.toml");
    let solver = LegSolver::new(&mechanism);
    // Hip level with the ankle, straight ahead and behind; pelvis turned by right angles every way.
    for ahead in [-2.0, -0.5, -0.0, 0.0, 0.5, 2.0] {
        for quarters in 0..64_u8 {
            let quarter = |shift: u8| f64::from((quarters >> shift) & 3) * std::f64::consts::FRAC_PI_2;
            let turn = UnitQuaternion::from_euler_angles(quarter(0), quarter(2), quarter(4));
            let ankle = Vector3::new(0.0, 0.0, mechanism.sole.ankle_height);
            let pelvis = Isometry3::from_parts(Translation3::from(ankle + Vector3::x() * ahead), turn);
            let feet = [Isometry3::identity(), Isometry3::from(ankle + turn * Vector3::y() * 0.19)];
            for side in Side::BOTH {
                let mut angles = JointVector::ZERO;
                let reached = solver.solve(side, &pelvis, &feet[side.index()], &mut angles);
                assert!(angles.is_finite(), "{ahead} m ahead, {quarters} quarters, {side:?}: {angles:?}");
                assert_eq!(reached.is_ok(), ahead.abs() == 0.5);
            }
        }
    }

    let nowhere = Isometry3::translation(f64::NAN, 0.0, 0.0);
    let mut angles = JointVector::unit(Joint::RightKnee);
    let reached = solver.solve(Side::Right, &nowhere, &Isometry3::identity(), &mut angles);
    assert_eq!(reached.expect_err("no pose").residual, f64::INFINITY);
    assert_eq!(angles, JointVector::unit(Joint::RightKnee));
}
