//! MuJoCo loads the exported robot unchanged and agrees with our dynamics to 1e-9: mass, centre of mass, torques,
//! ground wrench and mass matrix over random motions.
//!
//! Needs Python: `cargo test --workspace --tests -- --ignored`.

use std::io::Write;
use std::process::Stdio;

use config::Config;
use dynamics::{NewtonEuler, Tree, mass_matrix};
use halfstep_tests::walking::plant_parameters;
use halfstep_tests::{mechanism, python, random, random_motion, repository};
use interchange::mjcf::mjcf_text;
use interchange::urdf::urdf_text;
use model::{Joint, Mechanism, Motion};
use robots::ROBOTS;
use serde_json::{Value, json};

const STATES: usize = 20;

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn mujoco_agrees_with_our_dynamics() {
    let mut python = python();
    let mechanism = mechanism();
    let mut random = random(6);
    let motions: Vec<Motion> = (0..STATES).map(|_| random_motion(&mut random)).collect();
    let told = json!({
        "mjcf": mjcf_text(&mechanism, &plant_parameters(), 1e-3),
        "joints": Joint::ALL.map(Joint::name),
        "states": motions.iter().map(|motion| json!({
            "angles": motion.angles.0, "rates": motion.rates.0, "accelerations": motion.accelerations.0,
        })).collect::<Vec<_>>(),
    });
    let script = repository().join("tools/mujoco_plant/agreement.py");
    let mut child = python.arg(script).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("Python");
    child.stdin.take().expect("a pipe").write_all(told.to_string().as_bytes()).expect("somebody who reads");
    let output = child.wait_with_output().expect("a child");
    assert!(output.status.success());
    let theirs: Value = serde_json::from_slice(&output.stdout).expect("JSON");

    let tree = Tree::new(&mechanism);
    assert_close(&[tree.mass], &[theirs["mass"].as_f64().expect("a number")], "mass");
    let mut inverse = NewtonEuler::default();
    for (motion, theirs) in motions.iter().zip(theirs["states"].as_array().expect("states")) {
        inverse.compute_fixed_base(&tree, motion);
        assert_close(&inverse.torques.0, &numbers(&theirs["torques"]), "torques");
        assert_close(inverse.ground.force.as_slice(), &numbers(&theirs["ground_force"]), "ground force");
        assert_close(inverse.ground.moment.as_slice(), &numbers(&theirs["ground_moment"]), "ground moment");
        assert_close(inverse.kinematics.com(&tree).as_slice(), &numbers(&theirs["com"]), "centre of mass");
        let ours = mass_matrix(&tree, &inverse.kinematics);
        for (index, row) in theirs["mass_matrix"].as_array().expect("rows").iter().enumerate() {
            let ours: Vec<f64> = ours.row(index).iter().copied().collect();
            assert_close(&ours, &numbers(row), "mass matrix");
        }
    }
}

/// The URDF loads unchanged, too: a fixed right foot and 18 joints.
#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn mujoco_loads_the_exported_urdf() {
    let mut python = python();
    let program = "import sys, mujoco; print(mujoco.MjModel.from_xml_string(sys.stdin.read()).nv)";
    let mut child = python.args(["-c", program]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("Python");
    let text = urdf_text(&mechanism()).expect("a robot");
    child.stdin.take().expect("a pipe").write_all(text.as_bytes()).expect("somebody who reads");
    let output = child.wait_with_output().expect("a child");
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "18");
}

/// MuJoCo loads every robot in the box from both formats, with its joints and its mass.
#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn mujoco_loads_every_robot_in_the_box() {
    let program = "import json, sys, mujoco
told = json.load(sys.stdin)
model, urdf = (mujoco.MjModel.from_xml_string(told[key]) for key in ('mjcf', 'urdf'))
print(json.dumps([sum(model.body_mass), model.nv, model.nu, urdf.nv]))";
    for robot in ROBOTS {
        let mechanism = Mechanism::from_toml(robot.mechanism_text(), "mechanism.toml").expect("a mechanism");
        let told = json!({
            "mjcf": mjcf_text(&mechanism, &plant_parameters(), 1e-3),
            "urdf": urdf_text(&mechanism).expect("a robot"),
        });
        let mut python = python();
        let mut child =
            python.args(["-c", program]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("Python");
        child.stdin.take().expect("a pipe").write_all(told.to_string().as_bytes()).expect("somebody who reads");
        let output = child.wait_with_output().expect("a child");
        assert!(output.status.success(), "{} is not loaded", robot.name);
        let theirs: [f64; 4] = serde_json::from_slice(&output.stdout).expect("four numbers");
        let joints = Joint::ALL.into_iter().filter(|joint| mechanism.has(*joint)).count() as f64;
        assert_close(&[mechanism.mass(), 6.0 + joints, joints, joints], &theirs, robot.name);
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("an array").iter().map(|number| number.as_f64().expect("a number")).collect()
}

/// Relative where numbers are large, absolute where they are small.
fn assert_close(ours: &[f64], theirs: &[f64], what: &str) {
    let scale = theirs.iter().fold(1.0, |scale: f64, number| scale.max(number.abs()));
    assert_eq!(ours.len(), theirs.len(), "{what}");
    for (ours, theirs) in ours.iter().zip(theirs) {
        assert!((ours - theirs).abs() <= 1e-9 * scale, "{what}: {ours} against MuJoCo's {theirs}");
    }
}
