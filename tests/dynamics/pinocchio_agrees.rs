//! Torques, ground wrench, centre of mass, mass matrix and forward dynamics agree with Pinocchio to 1e-9.
//!
//! The reference numbers are committed; `tools/reference/pinocchio_reference.py` made them from the same mechanism
//! file.

use dynamics::{ArticulatedBody, Kinematics, LinkLoad, NewtonEuler, Tree, mass_matrix};
use halfstep_tests::{mechanism, repository};
use model::{Joint, JointVector, Motion, PerJoint, Wrench};
use nalgebra::{Isometry3, Matrix6, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

fn reference() -> Value {
    let file = repository().join("tests/data/pinocchio_reference.json");
    serde_json::from_str(&std::fs::read_to_string(file).expect("the reference is committed")).expect("it is JSON")
}

fn states<'v>(reference: &'v Value, kind: &str) -> &'v [Value] {
    let states = reference[kind].as_array().expect("a list of states");
    assert!(states.len() >= 5, "too few states to mean anything");
    states
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("an array").iter().map(|number| number.as_f64().expect("a number")).collect()
}

fn joints(value: &Value) -> JointVector {
    PerJoint(numbers(value).try_into().expect("twenty numbers"))
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_vec(numbers(value))
}

/// Relative where numbers are large, absolute where they are small.
fn assert_close(ours: &[f64], theirs: &[f64], what: &str) {
    let scale = theirs.iter().fold(1.0, |scale: f64, number| scale.max(number.abs()));
    for (ours, theirs) in ours.iter().zip(theirs) {
        assert!((ours - theirs).abs() <= 1e-9 * scale, "{what}: {ours} against Pinocchio's {theirs}");
    }
}

#[test]
fn pinocchio_agrees_on_inverse_dynamics() {
    let tree = Tree::new(&mechanism());
    let reference = reference();
    let mut inverse = NewtonEuler::default();
    for state in states(&reference, "fixed_base") {
        let motion = Motion {
            angles: joints(&state["angles"]),
            rates: joints(&state["rates"]),
            accelerations: joints(&state["accelerations"]),
        };
        inverse.compute_fixed_base(&tree, &motion);
        assert_close(&inverse.torques.0, &numbers(&state["torques"]), "torques");
        assert_close(inverse.ground.force.as_slice(), &numbers(&state["ground_force"]), "ground force");
        assert_close(inverse.ground.moment.as_slice(), &numbers(&state["ground_moment"]), "ground moment");
        assert_close(inverse.kinematics.com(&tree).as_slice(), &numbers(&state["com"]), "centre of mass");
        if let Some(rows) = state["mass_matrix"].as_array() {
            let matrix = mass_matrix(&tree, &inverse.kinematics);
            for (index, row) in rows.iter().enumerate() {
                let ours: Vec<f64> = matrix.row(index).iter().copied().collect();
                assert_close(&ours, &numbers(row), "mass matrix");
            }
        }
    }
}

#[test]
fn pinocchio_agrees_on_forward_dynamics_of_a_floating_robot() {
    let tree = Tree::new(&mechanism());
    let reference = reference();
    let mut body = ArticulatedBody::default();
    for state in states(&reference, "floating_base").iter().chain(states(&reference, "floating_base_pushed")) {
        let [x, y, z, w] = numbers(&state["base_orientation_xyzw"]).try_into().expect("a quaternion");
        let pose = Isometry3::from_parts(
            vector(&state["base_position"]).into(),
            UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
        );
        let angles = joints(&state["angles"]);
        let loads = push_on_left_foot(&tree, state, &pose, &angles);
        body.set_state(
            &tree,
            &pose,
            vector(&state["base_angular_velocity"]),
            vector(&state["base_velocity"]),
            &angles,
            &joints(&state["rates"]),
        );
        let found = body.accelerations(&tree, &joints(&state["torques"]), &JointVector::ZERO, loads.as_slice());
        assert_close(&found.joints.0, &numbers(&state["accelerations"]), "joint accelerations");
        assert_close(found.base_linear.as_slice(), &numbers(&state["base_acceleration"]), "base acceleration");
        assert_close(found.base_angular.as_slice(), &numbers(&state["base_angular_acceleration"]), "base rotation");
    }
}

/// The reference gives it about the left ankle; ours is told about the right sole's origin.
fn push_on_left_foot(tree: &Tree, state: &Value, pose: &Isometry3<f64>, angles: &JointVector) -> Vec<LinkLoad> {
    if state.get("left_foot_force").is_none() {
        return Vec::new();
    }
    let mut kinematics = Kinematics::default();
    kinematics.compute_floating_base(tree, pose, angles);
    let ankle = kinematics.origin[Joint::LeftAnkleRoll] - pose.translation.vector;
    let force = vector(&state["left_foot_force"]);
    let moment = vector(&state["left_foot_moment"]) + ankle.cross(&force);
    vec![LinkLoad { link: Joint::LeftAnkleRoll, wrench: Wrench { force, moment }, added_inertia: Matrix6::zeros() }]
}
