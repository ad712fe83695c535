//! Goal: a disk that becomes full while a run is recorded is told at once; the robot walks on, and what was written
//! before is summed up, drawn and replayed.
//!
//! It needs a small file system, which a user may mount in a namespace of their own where the system permits it.

use std::process::Command;

use halfstep_tests::command_line::CommandLine;

#[test]
fn a_full_disk_is_told_at_once_and_what_was_written_before_is_kept() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let script = "mkdir small && mount -t tmpfs -o size=3m tmpfs small || exit 77; \
                  $H walk --lockstep --for 4s --out small/run; echo walk $?; \
                  $H replay small/run; echo replay $?";
    let output = Command::new("unshare")
        .args(["-rm", "sh", "-c", script])
        .env("H", env!("CARGO_BIN_EXE_halfstep-under-test"))
        .current_dir(command_line.folder())
        .output();
    let ended = match output {
        Ok(ended) if ended.status.success() => ended,
        other => {
            eprintln!("NOT RUN: no file system can be mounted in a namespace: {other:?}");
            return;
        }
    };
    let [stdout, stderr] = [ended.stdout, ended.stderr].map(|text| String::from_utf8(text).unwrap());
    let told = stderr.lines().filter(|line| line.contains("s on the run is not recorded: ")).count();
    assert!(told >= 1 && stderr.contains("No space left on device"), "{stderr}");
    assert!(!stderr.contains("panicked"), "{stderr}");
    let lines: Vec<&str> = stdout.lines().collect();
    assert!(lines[0].contains(" half-step") && lines[0].contains(" in 4.0 s: "), "{stdout}");
    assert!(
        lines.iter().any(|line| line.starts_with("the controller did not record the run to its end: ")),
        "{stdout}"
    );
    assert!(lines.contains(&"walk 1") && lines.contains(&"replay 0"), "{stdout}");
    let setpoints = lines.iter().find_map(|line| line.strip_prefix("identical: ")?.split(' ').next()?.parse().ok());
    assert!(setpoints.is_some_and(|setpoints: u64| setpoints >= 500), "{stdout}");
}
