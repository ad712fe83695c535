//! A part of a run is drawn when it is asked for, two runs over each other, and the floor as it was.

use std::fs;

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

#[test]
fn a_part_of_a_run_is_drawn_with_the_summary_of_the_whole() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    assert_eq!(command_line.run("walk --lockstep --for 3s --out run").code, Some(0));
    let whole: Value = serde_json::from_str(&command_line.read("run/summary.json")).unwrap();
    let drawn = command_line.run("plot run --from 1 --to 1800ms --out part --json");
    assert_eq!(drawn.code, Some(0), "{}", drawn.stderr);
    let told: Value = serde_json::from_str(&drawn.stdout).unwrap();
    for of_all in ["half_steps", "distance_m", "least_margin", "zmp_error_rms_mm", "joint_loads", "cost_of_transport"] {
        assert!(!whole[of_all].is_null() && told["summary"][of_all] == whole[of_all], "{of_all}: {told}");
    }
    assert!(command_line.read("part/stick_walk.svg").contains("The walk from 1.0 to 1.8 s"));
    assert!(command_line.read("part/footprints.svg").len() < command_line.read("run/footprints.svg").len());
    assert!(told["files"].as_array().unwrap().iter().all(|file| {
        let file = command_line.folder().join("part").join(file.as_str().unwrap());
        fs::metadata(file).is_ok_and(|file| file.len() > 1000)
    }));
    for (part, says) in [
        ("--from 7 --to 9", "run: has nothing to draw from 7 to 9 s: the run was recorded from 0.000 to 3.000 s"),
        ("--from 2 --to 1", "--from 2 --to 1: must end after it begins"),
    ] {
        let refused = command_line.run(&format!("plot run {part} --out none"));
        assert_eq!((refused.code, refused.stderr.trim_end()), (Some(2), says));
        assert!(!command_line.folder().join("none").exists());
    }
}

#[test]
fn a_run_that_is_too_short_is_refused() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    assert_eq!(command_line.run("walk --lockstep --for 10ms --out run").code, Some(0));
    let refused = command_line.run("plot run");
    let says = "run: is too short to be drawn: it holds 10 ms of a run";
    assert_eq!((refused.code, refused.stderr.trim_end()), (Some(2), says));
}

#[test]
fn a_run_is_drawn_over_another_one_with_both_summaries() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for (seed, run) in ["one", "other"].into_iter().enumerate() {
        let walked = command_line.run(&format!("walk --lockstep --for 2s --seed {seed} --out {run}"));
        assert_eq!(walked.code, Some(0), "{}", walked.stderr);
    }
    let drawn = command_line.run("plot one --against other --out both --json");
    assert_eq!(drawn.code, Some(0), "{}", drawn.stderr);
    let told: Value = serde_json::from_str(&drawn.stdout).unwrap();
    for (which, run) in [("first", "one"), ("second", "other")] {
        let summary: Value = serde_json::from_str(&command_line.read(&format!("{run}/summary.json"))).unwrap();
        assert_eq!(told[which]["energy"], summary["energy"], "{which}");
    }
    assert_ne!(told["first"]["energy"], told["second"]["energy"], "another seed, other noise");
    let page = command_line.read("both/comparison.html");
    assert!(page.contains("<h1>one and other</h1>") && page.matches("<img").count() == 2);
    let table = command_line.run("plot one --against other --out both").stdout;
    assert!(table.contains("least margin") && table.contains("cost of transport"), "{table}");
}

#[test]
fn the_floor_is_drawn_as_the_recording_tells_it() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let plant = command_line.read("config/plant.toml");
    for (run, step) in [("flat", ""), ("stepped", "\n[[floor.step]]\nfrom_m = 0.6\nheight_m = 0.01\n")] {
        fs::write(command_line.folder().join("config/plant.toml"), plant.clone() + step).unwrap();
        let walked = command_line.run(&format!("walk --lockstep --for 3s --commands /dev/null --out {run}"));
        assert_eq!(walked.code, Some(0), "{}", walked.stderr);
        assert_eq!(command_line.run(&format!("plot {run} --out again-{run}")).code, Some(0));
        let picture = command_line.read(&format!("{run}/stick_walk.svg"));
        assert!(picture == command_line.read(&format!("again-{run}/stick_walk.svg")), "{run}");
        assert_eq!(heights_of_the_floor(&picture) > 1, run == "stepped");
    }
}

/// How many heights the line of the floor has in the side view of a picture.
fn heights_of_the_floor(svg: &str) -> usize {
    let side_view = svg.split("stroke=\"#999999\"").next().expect("a floor");
    let path = side_view.rsplit("d=\"").next().expect("a path").split('"').next().expect("its end");
    let numbers: Vec<&str> =
        path.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter(|n| !n.is_empty()).collect();
    let mut heights: Vec<&str> = numbers.chunks_exact(2).map(|point| point[1]).collect();
    heights.sort_unstable();
    heights.dedup();
    heights.len()
}
