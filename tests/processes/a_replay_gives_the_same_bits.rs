//! Goal: the controller, given what it was given in a recorded run, sets the same angles, rates and torques to the bit;
//! given anything else it does not, and the first difference is named.

use std::fs;
use std::path::Path;

use halfstep_tests::command_line::CommandLine;
use record::{Provenance, Recording, RecordingWriter, RunEvent, TimedEvent, provenance_of};

/// A new request every 0.3 s, some of them too much, with a stop and a start.
fn script() -> String {
    let line = |number: u32| {
        let t = 0.2 + 0.3 * f64::from(number);
        match number % 6 {
            0 => format!("{{\"t\":{t},\"turn_deg\":{}}}\n", f64::from(number) * 2.0),
            1 => format!("{{\"t\":{t},\"speed\":1.2,\"extension_deg\":3}}\n"),
            2 => format!("{{\"t\":{t},\"turn_deg\":30,\"speed\":1.5,\"extension_deg\":12}}\n"),
            3 => format!("{{\"t\":{t},\"speed\":0.8,\"turn_deg\":-8}}\n"),
            4 => format!("{{\"t\":{t},\"intent\":\"stop\"}}\n"),
            _ => format!("{{\"t\":{t},\"intent\":\"walk\",\"turn_deg\":0}}\n"),
        }
    };
    (0..30).map(line).collect()
}

#[test]
fn a_lockstep_run_replays_bit_for_bit() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    fs::write(command_line.folder().join("script.jsonl"), script()).unwrap();
    // With the committed script's pushes and faults: NaN, spikes, drop-outs.
    let walk = "walk --lockstep --for 10s --seed 5 --commands script.jsonl --out";
    let disturbed = format!("{walk} disturbed --disturbances config/disturbances_demo.toml");
    for (words, run) in [(format!("{walk} run --from-stand"), "run"), (disturbed, "disturbed")] {
        command_line.run(&words);
        let ended = command_line.run(&format!("replay {run}"));
        let said = (ended.code, ended.stdout.as_str());
        assert_eq!(said, (Some(0), "identical: 10000 setpoints\n"), "{run}: {}", ended.stderr);
    }
}

/// A tick's length is in the recording, whatever the rate.
#[test]
fn a_run_at_another_rate_replays_bit_for_bit() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    command_line.edit("config/realtime.toml", "rate_hz = 1000", "rate_hz = 500");
    command_line.run("walk --lockstep --for 2s --out run");
    assert_eq!(command_line.run("replay run").stdout, "identical: 1000 setpoints\n");
    let events = Recording::open(&command_line.folder().join("run/run.mcap")).unwrap();
    assert!((last_time(events) - 2.0).abs() < 0.01);
}

fn last_time(mut recording: Recording) -> f64 {
    std::iter::from_fn(|| recording.next_event().unwrap()).last().expect("something was recorded").time()
}

/// Deadlines are missed or not, and what can be granted is found out beside the loop, as the machine likes it.
#[test]
fn a_real_time_run_replays_bit_for_bit() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    fs::write(command_line.folder().join("script.jsonl"), script()).unwrap();
    let ended = command_line.run("walk --for 6s --commands script.jsonl --out run --json");
    let summary: serde_json::Value = serde_json::from_str(&ended.stdout).expect("a summary");
    let ended = command_line.run("replay run --json");
    let outcome: serde_json::Value = serde_json::from_str(&ended.stdout).expect("an outcome");
    assert!(outcome["difference"].is_null(), "{outcome}");
    // A machine so busy that the recording has gaps cannot replay what follows them.
    if summary["log_gaps"] == 0 {
        assert_eq!((ended.code, &outcome["cut"]), (Some(0), &serde_json::Value::Null), "{outcome}");
        assert!(outcome["setpoints"].as_u64() > Some(1000), "{outcome}");
    }
}

/// Copies a recording, with one angle measured in a tick changed by its last bit or by more.
fn alter(from: &Path, to: &Path, tick: u64, change: fn(f64) -> f64) {
    let mut writer = RecordingWriter::create(to, &provenance_of(from).unwrap()).unwrap();
    let mut recording = Recording::open(from).unwrap();
    while let Some(mut stamped) = recording.next_event().unwrap() {
        if let RunEvent::Measurement(measured) = &mut stamped.event
            && measured.tick == tick
        {
            measured.angles[4] = change(measured.angles[4]);
        }
        writer.write(stamped.time_ns, stamped.number, &stamped.event).unwrap();
    }
    writer.finish().unwrap();
}

#[test]
fn replay_names_the_first_tick_that_differs() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    assert_eq!(command_line.run("walk --lockstep --for 2s --out run").code, Some(0));
    let file = |name: &str| command_line.folder().join(name);
    alter(&file("run/run.mcap"), &file("same.mcap"), 1000, |angle| angle);
    assert_eq!(command_line.run("replay same.mcap").stdout, "identical: 2000 setpoints\n");

    alter(&file("run/run.mcap"), &file("other.mcap"), 1000, |angle| angle + 1e-6);
    let ended = command_line.run("replay other.mcap");
    assert_eq!(ended.code, Some(1), "{}", ended.stdout);
    let said = "differs in tick 1000 (1.000 s): ";
    assert!(ended.stdout.starts_with(said) && ended.stdout.contains(" of joint "), "{}", ended.stdout);
}

#[test]
fn replay_names_what_it_lacks() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    assert_eq!(command_line.run("walk --lockstep --for 1s --out run").code, Some(0));
    let from = command_line.folder().join("run/run.mcap");
    let copy = |name: &str, origin: &Provenance, lacks: fn(&TimedEvent) -> bool| {
        let mut writer = RecordingWriter::create(&command_line.folder().join(name), origin).unwrap();
        let mut recording = Recording::open(&from).unwrap();
        while let Some(stamped) = recording.next_event().unwrap() {
            if !lacks(&stamped) {
                writer.write(stamped.time_ns, stamped.number, &stamped.event).unwrap();
            }
        }
        writer.finish().unwrap();
    };

    copy("bare.mcap", &Provenance::default(), |_| false);
    let ended = command_line.run("replay bare.mcap");
    assert_eq!(ended.code, Some(2));
    assert!(ended.stderr.contains("bare.mcap: has no controller.toml attached"), "{}", ended.stderr);

    copy("gap.mcap", &provenance_of(&from).unwrap(), |stamped| (300..310).contains(&(stamped.time_ns / 1_000_000)));
    let ended = command_line.run("replay gap.mcap");
    let said = "identical: 300 setpoints\nreplay incomplete: recording gap: ticks 300 up to 310 are missing";
    assert!(ended.stdout.starts_with(said), "{}", ended.stdout);
}
