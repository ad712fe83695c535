//! The committed nominal regenerates bit for bit from the command that its header names.

use halfstep_tests::command_line::CommandLine;

const NOMINAL: &str = "config/nominal_half_step.csv";

#[test]
fn the_committed_nominal_regenerates_bit_for_bit() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let committed = command_line.read(NOMINAL);
    std::fs::remove_file(command_line.folder().join(NOMINAL)).unwrap();

    let command = committed.lines().find_map(|line| line.strip_prefix("# made by: halfstep ")).expect("a header");
    let ended = command_line.run(command);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(command_line.read(NOMINAL) == committed, "`halfstep {command}` makes another table");
}

#[test]
fn the_header_of_a_nominal_is_the_command_that_made_it() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let words = "synthesize --mechanism config/mechanism.toml --out longer.csv \
                 --recorded config/recorded_leg_shape.csv --step-length 0.26 --arm-swing 10 --intervals 50";
    let ended = command_line.run(&format!("{words} --figures pictures"));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let made = command_line.read("longer.csv");
    let says = made.lines().nth(1).unwrap().split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(says, format!("# made by: halfstep {}", words.split_whitespace().collect::<Vec<_>>().join(" ")));
    for picture in ["nominal_stick", "nominal_footprints"] {
        assert!(command_line.read(&format!("pictures/{picture}.svg")).starts_with("<svg"), "{picture}");
    }
}
