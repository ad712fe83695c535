//! Goal: what a run has recorded is not lost when its processes are killed: at most its last half second is missing.

use std::fs;
use std::path::Path;

use halfstep_tests::command_line::CommandLine;
use record::{Recording, TimedEvent};

fn events(file: &Path) -> (Vec<TimedEvent>, Option<String>) {
    let (mut recording, mut events) = (Recording::open(file).unwrap(), Vec::new());
    while let Some(event) = recording.next_event().unwrap() {
        events.push(event);
    }
    (events, recording.cut())
}

/// NaN included.
fn are_equal(one: &[TimedEvent], other: &[TimedEvent]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| format!("{one:?}") == format!("{other:?}"))
}

#[test]
fn a_recording_cut_off_anywhere_is_read_up_to_its_last_whole_chunk() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    assert_eq!(command_line.run("walk --lockstep --for 2s --out run").code, Some(0));
    let whole = fs::read(command_line.folder().join("run/run.mcap")).unwrap();
    let (all, cut) = events(&command_line.folder().join("run/run.mcap"));
    assert_eq!(cut, None);

    let file = command_line.folder().join("cut.mcap");
    let mut lengths: Vec<usize> = (1..40).map(|part| whole.len() * part / 40 + part).collect();
    lengths.extend([0, 1, 7, 9, 100, whole.len() - 1, whole.len() - 8, whole.len() - 9, whole.len() - 40]);
    lengths.sort();
    let mut most = 0;
    for length in lengths {
        fs::write(&file, &whole[..length]).unwrap();
        let (read, cut) = events(&file);
        assert!(are_equal(&read, &all[..read.len()]), "cut off after {length} bytes");
        assert!(read.len() >= most, "more bytes, more events");
        most = read.len();
        // Chunks end every half second.
        let last = read.last().map_or(0, |event| event.time_ns);
        let is_missing = (all.last().unwrap().time_ns - last) as f64 * 1e-9;
        let share = length as f64 / whole.len() as f64;
        assert!(is_missing < 2.0 * (1.0 - share) + 0.6, "{is_missing} s are missing of {share}");
        // Without its end mark alone it is as good as whole.
        assert_eq!(cut.is_some(), length < whole.len() - 8, "{length} of {}: {cut:?}", whole.len());
    }

    let damaged: Vec<u8> = whole.iter().enumerate().map(|(at, byte)| byte ^ u8::from(at == whole.len() / 2)).collect();
    fs::write(&file, damaged).unwrap();
    let (read, cut) = events(&file);
    assert!(are_equal(&read, &all[..read.len()]) && !read.is_empty() && read.len() < all.len());
    assert!(cut.is_some_and(|cut| cut.contains("cut.mcap: truncated, valid up to ")));
}

#[test]
fn a_killed_run_can_be_replayed_and_plotted() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller --lockstep --out run");
    command_line.wait_for_controller();
    let plant = command_line.start_here("plant --lockstep --out run");
    // Both have written several chunks.
    for part in ["run/controller.mcap", "run/plant.mcap"].map(|part| command_line.folder().join(part)) {
        while fs::metadata(&part).map_or(0, |file| file.len()) < 4_000_000 {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
    }
    controller.kill();
    plant.kill();

    let replayed = command_line.run("replay run");
    assert_eq!(replayed.code, Some(0), "{}{}", replayed.stdout, replayed.stderr);
    assert!(
        replayed.stdout.contains("replay incomplete: run/controller.mcap: truncated, valid up to "),
        "{}",
        replayed.stdout
    );
    let setpoints: u64 = replayed.stdout.split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!(setpoints > 1500, "{}", replayed.stdout);

    let drawn = command_line.run("plot run");
    assert_eq!(drawn.code, Some(0), "{}", drawn.stderr);
    assert!(drawn.stderr.contains("run/plant.mcap: truncated, valid up to "), "{}", drawn.stderr);
    assert!(command_line.read("run/footprints.svg").contains("half-steps"));
}
