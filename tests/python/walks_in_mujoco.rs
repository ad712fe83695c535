//! The robot walks in MuJoCo, with the parameters that it walks with in our own plant, and the same walk is the same to
//! the byte.
//!
//! Needs Python: `cargo test --workspace --tests -- --ignored`.

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn walks_in_mujoco_the_same_each_time() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let walk = |plant: &str, folder: &str| -> Value {
        let words = format!("walk --plant {plant} --lockstep --for 8s --seed 3 --out {folder} --json");
        let ended = command_line.run(&words);
        assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        serde_json::from_str(&ended.stdout).expect("a summary")
    };
    let summary = walk("mujoco", "first");
    assert_eq!((&summary["falls"], &summary["plant"]), (&0.into(), &"mujoco".into()));
    walk("mujoco", "again");
    let log = |folder: &str| command_line.csv(folder, "plant");
    assert!(log("again") == log("first"), "the same walk leaves the same log");

    // The same sensors' noise, other physics.
    let ours = walk("rust", "ours");
    assert!(log("ours") != log("first"), "two engines");
    assert_eq!(ours["half_steps"], summary["half_steps"]);
    let apart = ours["distance_m"].as_f64().unwrap() - summary["distance_m"].as_f64().unwrap();
    assert!(apart.abs() < 0.02, "the two walks end {apart} m apart");
}
