//! Held joints in mechanism files: with links of their own, or welded as they were until 0.1.0.

use config::Config;
use model::{Joint, Mechanism};

fn g1() -> String {
    let file = format!("{}/../../config/robots/g1/mechanism.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(file).expect("it is committed")
}

fn read(text: &str) -> Result<Mechanism, String> {
    Mechanism::from_toml(text, "mechanism.toml").map_err(|errors| errors.to_string())
}

#[test]
fn held_joints_without_a_link_are_welded() {
    let text = g1();
    let (joints, held) = text.split_at(text.find("[[held]]").expect("it has held joints"));
    let kept = |line: &&str| ["[[held]]", "urdf =", "at_deg ="].iter().any(|key| line.starts_with(key));
    let joints: Vec<&str> = joints.lines().filter(|line| !line.starts_with("parent_held")).collect();
    let held: Vec<&str> = held.lines().filter(kept).collect();
    let welded = read(&format!("{}\n{}\n", joints.join("\n"), held.join("\n"))).expect("older files are read");
    assert_eq!(welded.unlumped().mechanism, welded);
    assert!(welded.unlumped().held.is_empty());

    let turning = read(&text).expect("the committed file");
    assert_eq!(turning.links, welded.links, "the controller knows the same robot");
    assert_eq!(turning.body_fingerprint, welded.body_fingerprint);
    assert_ne!(turning.fingerprint, welded.fingerprint);
}

#[test]
fn held_joints_are_in_the_order_of_what_carries_them_and_bear_the_robot_or_not() {
    let robot = read(&g1()).expect("the committed file").unlumped();
    assert_eq!(robot.held.len(), 11);
    for (index, link) in robot.held.iter().enumerate() {
        assert!(link.below.is_none_or(|below| below < index && robot.held[below].mount == link.mount));
    }
    let waist = robot.held.iter().position(|link| link.carries.iter().any(|joint| !joint.is_in_arm()));
    let waist = waist.expect("its waist turns");
    let servos = robot.mechanism.servos;
    for index in 0..robot.held.len() {
        let expected = if index == waist { servos.legs_and_waist } else { servos.arms };
        assert_eq!(*robot.servo_of(index), expected);
    }
    let forearm = robot.held.iter().find(|link| link.carries == [Joint::RightElbow]).expect("its upper arm turns");
    assert!(forearm.below.is_some(), "after the joint that spreads the arm");
}

#[test]
fn impossible_held_joints_are_refused_with_their_lines() {
    let text = g1();
    let refused = |from: &str, to: &str, must: &str| {
        assert!(text.contains(from), "{from}");
        let errors = read(&text.replacen(from, to, 1)).expect_err(must);
        assert!(errors.contains(must), "{errors}");
    };
    refused("parent_held = \"left_shoulder_roll_joint\"", "parent_held = \"nobody\"", "parent_held");
    refused("parent_held = \"right_shoulder_yaw_joint\"", "parent_held = \"waist_yaw_joint\"", "with the parent");
    let held = text.find("[[held]]").expect("it has held joints");
    let errors = read(&format!("{text}\n{}", &text[held..])).expect_err("each is held twice");
    assert!(errors.contains("must be held once, and held[0] is that joint already"), "{errors}");
    refused(
        "urdf = \"right_wrist_yaw_joint\"",
        "urdf = \"right_knee_joint\"",
        "joint.right_knee is that joint already",
    );
    let far = format!("{}{}", &text[..held], text[held..].replacen("origin_m = [", "origin_m = [9e9, ", 1));
    assert!(!read(&far).expect_err("four numbers").contains("NaN"), "what is no number is told once");
    let (joints, tables) = text.split_at(held);
    let heavy = format!("{joints}{}", tables.replacen("mass_kg = ", "mass_kg = 9", 1));
    let errors = read(&heavy).expect_err("more than all of the link");
    let line = heavy[..heavy.find("mass_kg = 9").expect("it is there")].matches('\n').count() + 1;
    let first = format!("mechanism.toml:{line}:11: held[0].mass_kg");
    assert!(errors.starts_with(&first) && errors.contains("must leave a body of joint."), "{first}: {errors}");
    // What is carried by a joint that is wrong is not wrong, too.
    let carrier = "urdf = \"left_shoulder_roll_joint\"";
    let at = text.find(carrier).expect("it carries the upper arm");
    let lost = format!("{}{}", &text[..at], text[at..].replacen("parent = \"", "parent = \"no_", 1));
    let errors = read(&lost).expect_err("there is no such joint");
    assert_eq!(errors.lines().count(), 1, "{errors}");
    let massless = format!("{joints}{}", tables.replacen("armature_kg_m2 = ", "armature_kg_m2 = 0 # ", 1));
    assert!(read(&massless).expect_err("no rotor").contains("armature_kg_m2"));
}
