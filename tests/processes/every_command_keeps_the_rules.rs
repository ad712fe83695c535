//! What holds for every command: one JSON value with `--json`, also after an error; the same exit codes; nothing but
//! errors with `--quiet`; a closed pipe is no error; files are writable before the work, and never replaced silently.
//! The commands are those that clap knows: a new one needs a row.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::process::Stdio;

use halfstep_tests::command_line::{CommandLine, Ended, Running};
use interface::Reason;
use serde_json::Value;

/// How a command is called here, and what is to come of it. `HERE` stands for the option of a running instance, `GONE`
/// for that of one that does not run, `RUN` for the folder of a recorded run.
struct Row {
    command: &'static str,
    /// Words after the command with which it succeeds. `None` if it needs more than a test has: a terminal, a browser
    /// or a machine of its own.
    works: Option<&'static str>,
    /// Words with which it fails, and the exit code; beside a wrong command line, which is tried with all.
    fails: Option<(&'static str, i32)>,
}

const fn row(command: &'static str, works: Option<&'static str>, fails: Option<(&'static str, i32)>) -> Row {
    Row { command, works, fails }
}

const NO_CONFIG: Option<(&str, i32)> = Some(("--config nowhere", 2));
const NO_CONTROLLER: Option<(&str, i32)> = Some(("GONE", 1));

const ROWS: &[Row] = &[
    row("walk", Some("--lockstep --for 1s --out OUT"), NO_CONFIG),
    row("controller", None, NO_CONFIG),
    row("plant", None, NO_CONFIG),
    row("send turn", Some("5 HERE"), Some(("5 GONE", 1))),
    row("send speed", Some("1.1 HERE"), Some(("1 GONE", 1))),
    row("send extend", Some("5 HERE"), Some(("5 GONE", 1))),
    row("send sidestep", Some("2 HERE"), Some(("2 GONE", 1))),
    row("send velocity", Some("0.2 HERE"), Some(("0.2 GONE", 1))),
    row("send goto", Some("9 0 HERE --wait"), Some(("1 0 GONE --wait", 1))),
    row("send footsteps", Some("steps.json --relative HERE"), Some(("nowhere.json GONE", 2))),
    row("send walk", Some("HERE"), NO_CONTROLLER),
    row("send in-place", Some("HERE"), NO_CONTROLLER),
    row("send stop", Some("HERE"), NO_CONTROLLER),
    row("send hold", Some("HERE"), NO_CONTROLLER),
    // Nothing is latched.
    row("send reset", None, Some(("HERE", 1))),
    row("stream", Some("commands.jsonl HERE"), Some(("nowhere.jsonl GONE", 2))),
    // Its output is no terminal here.
    row("teleop", None, Some(("HERE", 2))),
    row("view", None, Some(("nowhere", 2))),
    row("status", Some(""), None),
    row("watch", None, NO_CONTROLLER),
    row("synthesize", Some("--out OUT/half_step.csv"), Some(("--step-length -1 --out OUT/none.csv", 2))),
    row("paper", Some("--figure 22 --out OUT"), NO_CONFIG),
    row("check", Some(""), NO_CONFIG),
    // It simulates minutes.
    row("doctor", None, NO_CONFIG),
    row("bench compute", Some("--rounds 1 --slice 1ms --out OUT"), NO_CONFIG),
    row("bench latency", None, NO_CONFIG),
    row("bench jitter", None, NO_CONFIG),
    row("export urdf", Some("--out OUT/robot.urdf"), Some(("--mechanism nowhere.toml", 2))),
    row("export mjcf", Some("--out OUT/robot.xml"), Some(("--mechanism nowhere.toml", 2))),
    row("export python", Some("--out OUT/messages.py"), Some(("--out config", 2))),
    row("import", Some("robot.urdf --map map.toml --out OUT"), Some(("nowhere.urdf --out OUT", 2))),
    row("robots", Some(""), None),
    row("plot", Some("RUN --csv --out OUT"), Some(("nowhere", 2))),
    row("replay", Some("RUN"), Some(("nowhere", 2))),
];

/// Commands that print a value for each line.
const LINES: &[&str] = &["stream", "watch"];
/// Commands whose files are never in the way: an earlier run is set aside, or recordings are numbered.
const SETS_ASIDE: &[&str] = &["walk", "controller", "plant"];

/// How often a request may expire.
const TRIES: u32 = 10;

/// A folder with what the rows need, and a robot that walks in lockstep.
struct Workbench {
    command_line: CommandLine,
    _pair: [Running; 2],
}

impl Workbench {
    fn new() -> Self {
        let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
        let write = |file: &str, text: &str| fs::write(command_line.folder().join(file), text).unwrap();
        write("commands.jsonl", "{\"turn_deg\":3}\n{\"turn_deg\":0}\n");
        write(
            "steps.json",
            "[{\"side\":\"left\",\"x_m\":0.1,\"y_m\":0.1,\"heading_deg\":0},\
             {\"side\":\"right\",\"x_m\":0.1,\"y_m\":-0.1,\"heading_deg\":0}]",
        );
        write("blocked", "no folder");
        command_line.copy_scenarios();
        assert_eq!(command_line.run("walk --lockstep --for 1s --out run").code, Some(0));
        let exported = command_line.run("export urdf --out robot.urdf");
        assert_eq!(exported.code, Some(0), "{}", exported.stderr);
        let sole = halfstep_tests::mechanism().sole;
        let (behind, ahead, width, height) = (sole.behind, sole.ahead, sole.inside + sole.outside, sole.ankle_height);
        let size = format!("behind_m = {behind}\nahead_m = {ahead}\nwidth_m = {width}\nankle_height_m = {height}\n");
        write("map.toml", &format!("name = \"Our own\"\n\n[sole]\n{size}"));
        let controller = command_line.start_here("controller --lockstep --from-stand");
        command_line.wait_for_controller();
        let plant = command_line.start_here("plant --lockstep --from-stand");
        Self { command_line, _pair: [controller, plant] }
    }

    fn words(&self, words: &str, out: &str) -> String {
        let here = format!("--instance {}", self.command_line.instance());
        words.replace("HERE", &here).replace("GONE", "--instance nobody").replace("RUN", "run").replace("OUT", out)
    }

    /// Runs a command. One whose request has expired, as on a machine that is busy, is run again.
    fn run(&self, row: &Row, words: &str, out: &str, more: &str) -> Ended {
        let words = self.words(&format!("{} {words} {more}", row.command), out);
        let has_expired = |ended: &Ended| ended.stdout.contains(Reason::Expired.text());
        let runs = || self.command_line.run(&words);
        (0..TRIES).map(|_| runs()).find(|ended| !has_expired(ended)).unwrap_or_else(runs)
    }
}

/// The values that a command printed; panics if it is anything else.
fn values(ended: &Ended, what: &str) -> Vec<Value> {
    let lines = ended.stdout.lines();
    lines
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{what}: {error}: {}", ended.stdout)))
        .collect()
}

#[test]
fn every_command_has_a_row() {
    let mut known = BTreeSet::new();
    let mut open = vec![(String::new(), halfstep::command_line())];
    while let Some((path, command)) = open.pop() {
        let below = command.get_subcommands().filter(|below| !below.is_hide_set() && below.get_name() != "help");
        let below: Vec<_> = below.map(|below| (format!("{path} {}", below.get_name()), below.clone())).collect();
        if below.is_empty() {
            known.insert(path.trim().to_owned());
        }
        open.extend(below);
    }
    let rows: BTreeSet<String> = ROWS.iter().map(|row| row.command.to_owned()).collect();
    assert_eq!(known, rows);
    assert!(LINES.iter().chain(SETS_ASIDE).all(|command| rows.contains(*command)));
}

#[test]
fn a_wrong_command_line_is_one_json_value_and_exit_code_2() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for row in ROWS {
        let what = format!("{} --no-such-option", row.command);
        let ended = command_line.run(&format!("{what} --json"));
        let values = values(&ended, &what);
        assert_eq!((ended.code, values.len()), (Some(2), 1), "{what}: {}", ended.stderr);
        assert!(values[0]["error"].as_str().is_some_and(|error| error.contains("--no-such-option")), "{values:?}");
    }
}

#[test]
fn every_command_prints_json_if_asked_and_keeps_quiet_if_asked() {
    let bench = Workbench::new();
    for row in ROWS {
        if let Some(words) = row.works {
            let what = format!("{} {words}", row.command);
            let out = format!("works-{}", row.command.replace(' ', "-"));
            let ended = bench.run(row, words, &out, "--json --quiet");
            let values = values(&ended, &what);
            assert_eq!(ended.code, Some(0), "{what}: {}{}", ended.stdout, ended.stderr);
            assert_eq!(ended.stderr, "", "{what}");
            assert!(values.len() == 1 || LINES.contains(&row.command), "{what}: {}", ended.stdout);
        }
        if let Some((words, code)) = row.fails {
            let what = format!("{} {words}", row.command);
            let ended = bench.run(row, words, "fails", "--json --quiet");
            let values = values(&ended, &what);
            assert_eq!((ended.code, values.len()), (Some(code), 1), "{what}: {}{}", ended.stdout, ended.stderr);
            let is_reply = row.command.starts_with("send") && values[0]["verdict"] == "refused";
            assert!(is_reply || values[0]["error"].is_string(), "{what}: {values:?}");
            assert!(is_reply || !ended.stderr.is_empty(), "{what}: an error is told, also when all else is quiet");
        }
    }
}

#[test]
fn a_reader_that_has_read_enough_is_no_error() {
    let bench = Workbench::new();
    for row in ROWS {
        let (words, code) = match (row.works, row.fails) {
            (Some(words), _) => (words, 0),
            (None, Some(fails)) => fails,
            (None, None) => continue,
        };
        let out = format!("closed-{}", row.command.replace(' ', "-"));
        let words = bench.words(&format!("{} {words}", row.command), &out);
        let log = bench.command_line.folder().join("log");
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let stderr: Stdio = File::create(&log).unwrap().into();
        let mut child = bench.command_line.spawn(&words, writer.into(), stderr);
        drop(child.stdin.take());
        let ended = child.wait().unwrap();
        let told = fs::read_to_string(&log).unwrap();
        assert_eq!(ended.code(), Some(code), "{words}: {told}");
        assert!(!told.contains("Broken pipe") && !told.contains("panicked"), "{words}: {told}");
    }
}

/// The rows of commands with an option for an output.
fn writing() -> impl Iterator<Item = (&'static Row, String)> {
    ROWS.iter().flat_map(|row| {
        let mut command = halfstep::command_line();
        command.build();
        for name in row.command.split(' ') {
            command = command.find_subcommand(name).expect("a command").clone();
        }
        let options = command.get_arguments().filter(|option| ["out", "figures"].contains(&option.get_id().as_str()));
        options.map(|option| (row, option.get_id().to_string())).collect::<Vec<_>>()
    })
}

#[test]
fn an_output_that_cannot_be_written_is_told_before_the_work() {
    let bench = Workbench::new();
    for (row, option) in writing() {
        let words = row.works.unwrap_or("--out OUT");
        let words = if option == "figures" { format!("{words} --figures blocked/OUT") } else { words.to_owned() };
        let out = if option == "figures" { "figures" } else { "blocked/out" };
        let ended = bench.run(row, &words, out, "--json");
        let what = format!("{} {words}", row.command);
        let values = values(&ended, &what);
        assert_eq!((ended.code, values.len()), (Some(1), 1), "{what}: {}{}", ended.stdout, ended.stderr);
        assert!(values[0]["error"].as_str().is_some_and(|error| error.contains("blocked")), "{what}: {values:?}");
        // Neither progress nor modes were told.
        assert_eq!(ended.stderr.lines().count(), 1, "{what}: {}", ended.stderr);
    }
}

/// A benchmark that takes too long for a test refuses at once to replace an earlier one.
fn refuses_before_it_measures(bench: &Workbench, row: &Row) {
    let folder = bench.command_line.folder().join("measured");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("bench.json"), "an earlier one").unwrap();
    let refused = bench.run(row, "--out OUT", "measured", "");
    assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""), "{}: {}", row.command, refused.stderr);
    assert!(refused.stderr.contains("measured/bench.json") && refused.stderr.contains("--force"), "{}", refused.stderr);
}

#[test]
fn no_command_replaces_another_file_unless_it_is_forced_to() {
    let bench = Workbench::new();
    for (row, option) in writing().filter(|(row, _)| !SETS_ASIDE.contains(&row.command)) {
        let Some(words) = row.works else {
            refuses_before_it_measures(&bench, row);
            continue;
        };
        let words = if option == "figures" { format!("{words} --figures OUT/figures") } else { words.to_owned() };
        let out = format!("kept-{}-{option}", row.command.replace(' ', "-"));
        let what = format!("{} {words}", row.command);
        let first = bench.run(row, &words, &out, "");
        assert_eq!(first.code, Some(0), "{what}: {}", first.stderr);
        let folder = bench.command_line.folder().join(&out);
        let folder = if option == "figures" { folder.join("figures") } else { folder };
        let files: Vec<_> = fs::read_dir(&folder).unwrap().flatten().map(|file| file.path()).collect();
        let files: Vec<_> = files.into_iter().filter(|file| file.is_file()).collect();
        assert!(!files.is_empty(), "{what}");
        // A benchmark is never twice the same.
        if row.command != "bench compute" {
            let again = bench.run(row, &words, &out, "");
            assert_eq!(again.code, Some(0), "{what} again: {}", again.stderr);
        }
        for file in [&files[0], &files[files.len() - 1]] {
            let written = fs::read(file).unwrap();
            fs::write(file, "of somebody else").unwrap();
            let refused = bench.run(row, &words, &out, "");
            assert_eq!(refused.code, Some(2), "{what}: {}", refused.stderr);
            assert!(refused.stderr.contains("--force"), "{what}: {}", refused.stderr);
            assert_eq!(fs::read(file).unwrap(), b"of somebody else", "{}", file.display());
            fs::write(file, written).unwrap();
        }
        fs::write(&files[0], "of somebody else").unwrap();
        let forced = bench.run(row, &words, &out, "--force");
        assert_eq!(forced.code, Some(0), "{what} --force: {}", forced.stderr);
        assert_ne!(fs::read(&files[0]).unwrap(), b"of somebody else", "{what}");
    }
}
