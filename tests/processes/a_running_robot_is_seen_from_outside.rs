//! `status` lists the robots that run, and `watch` follows one to its end. Both only look on.

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

fn command_line() -> CommandLine {
    CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"))
}

fn status(command_line: &CommandLine) -> Value {
    let ended = command_line.run("status --json");
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    serde_json::from_str(&ended.stdout).expect("one value")
}

#[test]
fn where_nothing_runs_status_says_so() {
    let command_line = command_line();
    let ended = command_line.run("status");
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""));
    assert_eq!(ended.stdout, "no robot of yours is running; `halfstep walk` starts one\n");
    assert_eq!(status(&command_line), Value::Array(Vec::new()));
}

#[test]
fn status_tells_who_is_there_and_what_the_robot_does() {
    let command_line = command_line();
    let controller = command_line.start_here("controller --lockstep");
    command_line.wait_for_controller();
    let waiting = &status(&command_line)[0];
    assert_eq!(waiting["instance"], command_line.instance());
    assert_eq!((&waiting["note"], &waiting["plant"]), (&"waits for its plant".into(), &Value::Null));

    let plant = command_line.start_here("plant --lockstep");
    let watch = command_line.start_here("watch");
    let sent = command_line.start_here("send speed 1.2").finish();
    assert_eq!(sent.code, Some(0), "{}", sent.stderr);
    let walking = loop {
        let walking = status(&command_line)[0].take();
        if walking["half_step"].as_u64() > Some(2) {
            break walking;
        }
    };
    assert_eq!(walking["controller"], controller.id());
    assert_eq!(walking["plant"], plant.id());
    assert!(walking["observers"].as_array().is_some_and(|ids| ids.contains(&watch.id().into())), "{walking}");
    assert_eq!((&walking["mode"], &walking["clock"]), (&"walking".into(), &"lockstep".into()));
    assert!(walking["robot"].as_str().is_some_and(|name| name.starts_with("paper: ")), "{walking}");
    assert_eq!((&walking["rate_hz"], &walking["faults"]), (&1000.into(), &Value::Array(Vec::new())));
    assert!(walking["x_m"].as_f64() > Some(0.3), "{walking}");
    assert!(walking["measured_rate_hz"].as_f64() > Some(0.0), "{walking}");

    let text = command_line.run("status").stdout;
    assert!(text.starts_with(&format!("{}: walking at ", command_line.instance())), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    plant.end();
    controller.end();
    assert_eq!(watch.finish().code, Some(0));
}

#[test]
fn watch_tells_each_change_and_ends_with_the_controller() {
    let command_line = command_line();
    let controller = command_line.start_here("controller --lockstep --from-stand");
    command_line.wait_for_controller();
    let (text, json) = (command_line.start_here("watch"), command_line.start_here("watch --every 500ms --json"));
    // Both listen before anything happens.
    while status(&command_line)[0]["observers"].as_array().map_or(0, Vec::len) < 2 {}
    let plant = command_line.start_here("plant --lockstep --from-stand");
    let walked = command_line.start_here("send goto 1 0 --wait").finish();
    assert_eq!(walked.code, Some(0), "{}", walked.stderr);
    plant.end();
    controller.end();
    let (text, json) = (text.finish(), json.finish());
    assert_eq!((text.code, json.code), (Some(0), Some(0)), "{}{}", text.stderr, json.stderr);
    for part in [" s standing ", " s walking ", " s arrived at the goal", " s the controller has left: standing"] {
        assert!(text.stdout.contains(part), "{part}: {}", text.stdout);
    }
    assert!(text.stdout.lines().all(|line| line.chars().count() <= 80), "{}", text.stdout);
    let events: Vec<Value> = json.stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let count = |event: &str| events.iter().filter(|told| told["event"] == event).count();
    assert!(count("mode") >= 3 && count("time") >= 2, "{}", json.stdout);
    assert_eq!((count("arrived"), count("left")), (1, 1), "{}", json.stdout);
}

#[test]
fn watch_ends_with_exit_code_1_when_the_robot_lies() {
    let command_line = command_line();
    std::fs::write(command_line.folder().join("drop_out.toml"), DROP_OUT).expect("written");
    let controller = command_line.start_here("controller --lockstep --for 6s");
    command_line.wait_for_controller();
    let watch = command_line.start_here("watch");
    while status(&command_line)[0]["observers"].as_array().map_or(0, Vec::len) < 1 {}
    command_line.start_here("plant --lockstep --for 6s --disturbances drop_out.toml").finish();
    assert_eq!(controller.finish().code, Some(1));
    let ended = watch.finish();
    assert_eq!(ended.code, Some(1), "{}", ended.stdout);
    assert!(ended.stdout.contains(" s fault: no valid measurement has arrived for too long"), "{}", ended.stdout);
    assert!(ended.stdout.ends_with(" s the controller has left: faulted\n"), "{}", ended.stdout);
}

/// No measurement for 0.3 s: longer than the controller bridges.
const DROP_OUT: &str = "[[sensor_fault]]\nat_s = 2.2\nlasts_s = 0.3\nkind = \"drop_out\"\n";

#[test]
fn a_watch_that_hangs_holds_up_nothing() {
    let command_line = command_line();
    let walk = |folder: &str, is_watched: bool| {
        let words = format!("--lockstep --for 4s --out {folder}");
        let controller = command_line.start_here(&format!("controller {words}"));
        command_line.wait_for_controller();
        let watch = is_watched.then(|| command_line.start_here("watch"));
        if let Some(watch) = &watch {
            while status(&command_line)[0]["observers"].as_array().map_or(0, Vec::len) < 1 {}
            // For good: whoever waited for it would wait for ever.
            watch.halt();
        }
        let plant = command_line.start_here(&format!("plant {words}"));
        assert_eq!([controller.finish().code, plant.finish().code], [Some(0); 2]);
    };
    walk("alone", false);
    walk("watched", true);
    assert!(command_line.csv("alone", "plant") == command_line.csv("watched", "plant"), "the walk is the same");
}
