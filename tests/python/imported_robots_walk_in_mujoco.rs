//! Robots of other makers walk in MuJoCo as their own URDFs describe them, with all joints, and with nothing set but
//! what `halfstep import` writes.
//!
//! Needs Python: `cargo test --workspace --tests -- --ignored`.

use std::fs;
use std::path::{Path, PathBuf};

use halfstep_tests::command_line::CommandLine;
use halfstep_tests::{python, repository, shared};
use record::provenance_of;
use serde_json::Value;

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn imported_robots_walk_in_mujoco_without_falling() {
    let Some(robots) = shared("robots") else { return };
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let falls: Vec<String> = folders(&robots).iter().filter_map(|robot| outcome(&command_line, robot)).collect();
    assert!(falls.is_empty(), "{}", falls.join("\n"));
}

/// Masses, places, torque limits, pushes and states of the models that MuJoCo makes of the URDFs.
#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn mujoco_models_of_urdfs_are_what_the_urdfs_say() {
    let Some(robots) = shared("robots") else { return };
    let script = repository().join("tools/mujoco_plant/test_urdf_model.py");
    let checked = python().arg("-B").arg(script).arg(robots).output().expect("Python");
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
}

/// By the URDF's own kinematics in MuJoCo the soles are within 1 mm and 0.1° of where the half-step has them.
#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn soles_are_where_the_plan_has_them_by_the_urdfs_own_kinematics() {
    let Some(robots) = shared("robots") else { return };
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let script = repository().join("tools/reference/soles_by_urdf.py");
    for robot in folders(&robots) {
        let name = robot.file_name().expect("a name").to_string_lossy().into_owned();
        let (urdf, sole) = (robot.join("robot.urdf"), robot.join("sole.toml"));
        let words = format!("import {} --map {} --out {name}", urdf.display(), sole.display());
        assert_eq!(command_line.run(&words).code, Some(0), "{name}");
        let judged = python().arg("-B").arg(&script).arg(command_line.folder().join(&name)).output().expect("Python");
        let said = String::from_utf8_lossy(&judged.stdout);
        let found: Value = serde_json::from_str(&said).unwrap_or_else(|error| panic!("{name}: {error}: {judged:?}"));
        let value = |key: &str| found[key].as_f64().expect("a number");
        assert!(value("off_mm") < 1.0 && value("off_deg") < 0.1 && value("tilt_deg") < 0.1, "{name}: {found}");
    }
}

/// Imports a robot and walks the demonstration's first ten seconds; what was wrong with that, if anything.
fn outcome(command_line: &CommandLine, robot: &Path) -> Option<String> {
    let name = robot.file_name()?.to_string_lossy();
    let (urdf, sole) = (robot.join("robot.urdf"), robot.join("sole.toml"));
    let words = format!("import {} --map {} --out {name}", urdf.display(), sole.display());
    let imported = command_line.run(&words);
    if imported.code != Some(0) {
        return Some(format!("{name} is not imported: {}", imported.stderr));
    }
    let words = format!("walk --config {name} --plant mujoco --lockstep --for 10s --seed 1 --out walk_{name} --json");
    let walked = command_line.run(&words);
    let Ok(summary) = serde_json::from_str::<Value>(&walked.stdout) else {
        return Some(format!("{name} does not walk: {}", walked.stderr));
    };
    if walked.code != Some(0) || summary["falls"] != 0 {
        return Some(format!("{name} falls: {summary}"));
    }
    // What MuJoCo was given.
    let recorded = provenance_of(&command_line.folder().join(format!("walk_{name}"))).expect("a recording");
    let given = recorded.file("robot.urdf") == Some(fs::read_to_string(urdf).expect("a URDF").as_str());
    (!given).then(|| format!("{name} does not walk as its URDF"))
}

/// The folders of the robots, by name.
fn folders(robots: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(robots).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut folders: Vec<PathBuf> = entries.filter(|path| path.is_dir()).collect();
    folders.sort();
    folders
}
