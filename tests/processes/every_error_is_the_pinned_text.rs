//! What a person reads after a mistake, word for word. `UPDATE_EXPECT=1 cargo test` writes a new `errors.txt`: read it
//! as a user would before it is committed.

use std::fs;

use expect_test::expect_file;
use halfstep_tests::command_line::CommandLine;

/// Mistakes on the command line, and in files that it names.
const MISTAKES: &[&str] = &[
    "",
    "wlak",
    "walk --for soon",
    "walk --for -1s",
    "walk --config nowhere",
    "walk --commands nowhere.jsonl",
    "walk --commands bad.jsonl",
    "walk --disturbances nowhere.toml",
    "walk --disturbances bad.toml",
    "walk --plant gazebo",
    "walk --instance a/b",
    "send --instance nobody turn 15",
    "send --instance nobody turn left",
    "send --instance nobody speed",
    "send --instance nobody turn 15 speed 1.2",
    "send --instance nobody goto 1",
    "send --instance nobody footsteps nowhere.json",
    "send --instance nobody footsteps bad.json",
    "stream --instance nobody bad.jsonl",
    "stream --instance nobody nowhere.jsonl",
    "plot nowhere",
    "plot bad.mcap",
    "plot bad.jsonl",
    "replay nowhere",
    "replay bad.mcap",
    "paper --figure one",
    "synthesize --step-length -1 --out half_step.csv",
    "synthesize --recorded nowhere.csv --out half_step.csv",
    "export urdf --mechanism nowhere.toml",
    "import nowhere.urdf --map bad.toml --out robot",
    "import bad.urdf --map bad.toml --out robot",
    "import bad.urdf --map nowhere.toml --out robot",
    "import bad.urdf",
    "check --config nowhere",
    "bench --config nowhere compute",
];

/// Mistakes in the configuration: file, what stands there, what a person wrote instead.
const EDITS: &[(&str, &str, &str)] = &[
    ("config/mechanism.toml", "resistance_ohm = 0.608", "resistance_ohm = -0.608"),
    ("config/mechanism.toml", "[sole]", "[soel]"),
    ("config/controller.toml", "gain = ", "gian = "),
    ("config/controller.toml", "speed_min = ", "speed_min = 7"),
    ("config/plant.toml", "friction = ", "friction = -"),
    ("config/realtime.toml", "rate_hz = 1000", "rate_hz = 60000"),
    ("config/nominal_half_step.csv", "# duration_s = 0.6", "# duration_s = soon"),
    ("config/commands_demo.jsonl", "\"speed\"", "\"sped\""),
];

fn printed(command_line: &CommandLine, words: &str) -> String {
    let ended = command_line.run(words);
    assert_ne!(ended.code, Some(0), "`halfstep {words}` must fail");
    assert!(!ended.stderr.contains("panicked"), "`halfstep {words}`: {}", ended.stderr);
    let folder = command_line.folder().display().to_string();
    let stderr = ended.stderr.replace(&folder, "FOLDER").replace("halfstep-under-test", "halfstep");
    let stderr = without_running(&stderr);
    format!("$ halfstep {words}\n{}exit code {}\n\n", ended.stdout + &stderr, ended.code.unwrap_or(-1))
}

/// The same lines without the names of other instances that run on this machine.
fn without_running(stderr: &str) -> String {
    stderr.lines().map(|line| line.split("; running: ").next().unwrap_or_default().to_owned() + "\n").collect()
}

#[test]
fn every_error_is_the_pinned_text() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let write = |file: &str, text: &str| fs::write(command_line.folder().join(file), text).unwrap();
    write(
        "bad.jsonl",
        "{\"t\":1,\"speed\":\"fast\"}\n{\"t\":2}\nturn 15\n{\"t\":3,\"turn_deg\":1e999}\n\
         {\"goto\":[{\"x_m\":1,\"y_m\":2},{\"x\":1}]}\n",
    );
    write("bad.json", "[{\"side\":\"left\",\"x_m\":0.2,\"y_m\":0.1,\"heading_deg\":0},\n{\"side\":\"left\"}]");
    write("bad.toml", "[[push]]\nat = 1\nwith = 2\n");
    write("bad.mcap", "no recording");
    write("bad.urdf", "<robot name=\"bad\"><link name=\"trunk\"></robot>");
    let mut text: String = MISTAKES.iter().map(|words| printed(&command_line, words)).collect();

    let committed: Vec<String> = EDITS.iter().map(|(file, ..)| command_line.read(file)).collect();
    for ((file, from, to), committed) in EDITS.iter().zip(&committed) {
        command_line.edit(file, from, to);
        text += &format!("# {file}: `{from}` → `{to}`\n{}", printed(&command_line, "check"));
        write(file, committed);
    }
    expect_file!["../data/errors.txt"].assert_eq(&text);
}
