//! Shared memory that is full or small is refused with what is needed and what is there, and a robot that walks can be
//! stopped all the same.
//!
//! Needs a mount namespace of its own; says so when it did not run.

use std::process::{Command, Output};

use halfstep_tests::command_line::CommandLine;

/// A shell script in a mount namespace whose `/dev/shm` has `size`; `None` if there can be none.
fn in_small_memory(command_line: &CommandLine, size: &str, script: &str) -> Option<Output> {
    let script = format!(
        "mount -t tmpfs -o size={size} tmpfs /dev/shm || exit 77\nH={}\n{script}",
        env!("CARGO_BIN_EXE_halfstep-under-test")
    );
    let output = Command::new("unshare")
        .args(["-rm", "sh", "-c", &script])
        .current_dir(command_line.folder())
        .env("XDG_RUNTIME_DIR", command_line.runtime_folder())
        .output()
        .ok();
    let output = output.filter(|output| output.status.code() != Some(77) && !output.stderr.starts_with(b"unshare"));
    if output.is_none() {
        eprintln!("NOT RUN: a small shared memory, because no mount namespace can be made");
    }
    output
}

#[test]
fn a_small_shared_memory_is_refused_with_what_is_needed_and_what_is_there() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for (size, role) in [("16k", "controller"), ("1m", "controller"), ("2200k", "operator"), ("3200k", "")] {
        let script = format!("$H walk --lockstep --for 1s --out walk-{size}; echo code $?");
        let Some(output) = in_small_memory(&command_line, size, &script) else { return };
        let (stdout, stderr) = (
            String::from_utf8_lossy(&output.stdout).into_owned(),
            String::from_utf8_lossy(&output.stderr).into_owned(),
        );
        if stdout.contains("code 0") {
            assert!(role.is_empty() || role == "operator", "{size} is enough: {stdout}");
            continue;
        }
        assert!(stdout.contains("code 1"), "{size}: {stdout}{stderr}");
        let told = stderr.contains("shared memory (/dev/shm) has no room for this")
            && stderr.contains("it needs ")
            && stderr.contains("--shm-size");
        assert!(told, "{size}: {stderr}");
    }
}

#[test]
fn a_stop_gets_through_when_another_program_fills_shared_memory() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let script = "
        $H controller --instance full --for 4s >controller.txt 2>&1 & C=$!
        $H plant --instance full --for 4s >plant.txt 2>&1 & P=$!
        n=0
        until $H send --instance full speed 1.0 >/dev/null 2>&1; do
            n=$((n+1)); [ $n -gt 200 ] && exit 1; sleep 0.05
        done
        dd if=/dev/zero of=/dev/shm/other bs=4k 2>/dev/null
        $H send --instance full turn 3 2>turn.txt; echo turn $?
        $H send --instance full stop; echo stop $?
        wait $C; echo controller $?; wait $P; echo plant $?
    ";
    let Some(output) = in_small_memory(&command_line, "24m", script) else { return };
    let stdout = String::from_utf8_lossy(&output.stdout);
    for line in ["turn 1", "stop 0"] {
        assert!(stdout.lines().any(|said| said == line), "{line}: {stdout}");
    }
    // 1 is a fall, on a machine that is too busy to walk without real time; above 128 is a signal.
    for role in ["controller", "plant"] {
        let ended = [0, 1].map(|code| format!("{role} {code}"));
        assert!(stdout.lines().any(|said| ended.iter().any(|ended| ended == said)), "{role}: {stdout}");
    }
    assert!(command_line.read("turn.txt").contains("no room for this operator"), "{}", command_line.read("turn.txt"));
    let told = command_line.read("controller.txt");
    assert!(told.contains(" half-steps, ") && !told.contains("half-steps, walking"), "{told}");
}
