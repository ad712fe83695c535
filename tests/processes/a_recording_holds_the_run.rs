//! Goal: a recording holds all that went over the wire, what the loop did, and the very files that the run began with.
//! Method: a walk in lockstep with a script of requests and a sensor that fails; everything is counted, and compared
//! with what is known of it otherwise.

use interface::{Lifetime, Verdict};
use std::fs;

use halfstep_tests::command_line::CommandLine;
use record::{Item, Provenance, Recording, RunEvent, TimedEvent};

const SCRIPT: &str =
    "{\"t\":0.5,\"turn_deg\":10}\n{\"t\":1.0,\"speed\":1.1,\"extension_deg\":3}\n{\"t\":2.0,\"speed\":9}\n";
const FAULTS: &str = "[[sensor_fault]]\nat_s = 1.2\nlasts_s = 0.01\nkind = \"nan\"\nvalues = \"angles\"\n\n\
                      [[push]]\nat_s = 2.2\nlasts_s = 0.1\nimpulse_n_s = [2, 0, 0]\nlink = \"pelvis\"\n";

fn read(command_line: &CommandLine, file: &str) -> (Vec<TimedEvent>, Provenance) {
    let mut recording = Recording::open(&command_line.folder().join(file)).unwrap();
    let (mut events, mut origin) = (Vec::new(), Provenance::default());
    while let Some(item) = recording.next_item().unwrap() {
        match item {
            Item::Event(event) => events.push(*event),
            Item::Metadata(metadata) => origin.metadata.push(metadata),
            Item::File(name, text) => origin.files.push((name, text)),
        }
    }
    assert_eq!(recording.cut(), None);
    (events, origin)
}

#[test]
fn a_recording_holds_every_message_request_and_configuration_file() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    fs::write(command_line.folder().join("script.jsonl"), SCRIPT).unwrap();
    fs::write(command_line.folder().join("faults.toml"), FAULTS).unwrap();
    let words = "walk --lockstep --for 3s --seed 7 --commands script.jsonl --disturbances faults.toml --out run";
    let ended = command_line.run(words);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let (events, origin) = read(&command_line, "run/run.mcap");

    // The files, byte for byte, and how it was started.
    for file in ["mechanism.toml", "nominal_half_step.csv", "controller.toml", "plant.toml", "realtime.toml"] {
        assert!(origin.file(file) == Some(&command_line.read(&format!("config/{file}"))), "{file}");
    }
    assert_eq!(origin.file("disturbances.toml"), Some(FAULTS));
    assert_eq!(origin.files.len(), 6, "each of them once");
    assert_eq!((origin.entry("plant", "seed"), origin.entry("controller", "clock")), (Some("7"), Some("lockstep")));
    assert_eq!(origin.entry("controller", "version"), Some(env!("CARGO_PKG_VERSION")));
    assert_eq!(origin.entry("controller end", "lost"), Some("0"));

    // Every tick, with what went in and what came out, on one timeline.
    assert!(events.is_sorted_by_key(|event| event.time_ns));
    let (mut ticks, mut measured, mut set, mut told, mut truth) = (vec![], vec![], vec![], vec![], vec![]);
    let (mut requests, mut replies) = (vec![], vec![]);
    for TimedEvent { number, event, .. } in &events {
        match event {
            RunEvent::Tick(tick) => ticks.push(*tick),
            RunEvent::Measurement(message) => measured.push(*message),
            RunEvent::Setpoint(message) => set.push(*message),
            RunEvent::Report(message) => told.push(*message),
            RunEvent::Truth(message) => truth.push(*message),
            RunEvent::Push(push) => panic!("nobody pushed: {push:?}"),
            RunEvent::Request(message) => requests.push((*number, *message)),
            RunEvent::Reply(message) => replies.push((*number, *message)),
        }
    }
    for tick in 0..3000 {
        assert_eq!((ticks[tick].tick, ticks[tick].periods), (tick as u64, 1));
        assert_eq!((measured[tick].tick, set[tick].tick, told[tick].tick), (tick as u64, tick as u64, tick as u64));
    }
    assert_eq!([ticks.len(), measured.len(), set.len(), told.len()], [3000; 4]);
    assert_eq!((truth.len(), truth[1].tick, truth[600].tick), (601, 5, 3000));

    // What the sensors failed to say was recorded as it was, and moved no joint.
    let is_nan = |tick: usize| measured[tick].angles.iter().all(|angle| angle.is_nan());
    let nan = (0..3000).filter(|&tick| is_nan(tick)).count();
    assert_eq!(nan, 10, "10 ms");
    assert!(set.iter().all(|setpoint| setpoint.checked().is_ok()));

    // Each request with its reply, and the tick in which it was put to the controller.
    let asked: Vec<_> = requests.iter().map(|(number, message)| (*number, message.checked().unwrap())).collect();
    assert_eq!(asked.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(asked[0].1.gait.turn, Some(10_f64.to_radians()));
    assert!(asked.iter().all(|(_, request)| request.lifetime == Lifetime::Latched));
    let answered: Vec<_> = replies.iter().map(|(number, reply)| (*number, reply.checked().unwrap().verdict)).collect();
    assert_eq!(answered, [(1, Verdict::Accepted), (2, Verdict::Accepted), (3, Verdict::Limited)]);
    let put: Vec<_> = ticks.iter().filter(|tick| tick.request > 0).map(|tick| (tick.tick, tick.request)).collect();
    assert_eq!(put, [(500, 1), (1000, 2), (2000, 3)]);
}

#[test]
fn plotting_a_recording_draws_the_same_pictures_again() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    assert_eq!(command_line.run("walk --lockstep --for 2s --out run").code, Some(0));
    let ended = command_line.run("plot run --out again --csv");
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    for picture in ["footprints.svg", "balance_over_time.svg", "margin_over_time.svg", "stick_walk.svg"] {
        assert!(
            command_line.read(&format!("run/{picture}")) == command_line.read(&format!("again/{picture}")),
            "{picture}"
        );
    }
    let rows = |file: &str| command_line.read(&format!("again/{file}")).lines().count();
    assert_eq!((rows("controller.csv"), rows("plant.csv")), (2001, 402));

    for (run, said) in [
        ("config", "config: holds no recording; it must hold run.mcap, or"),
        ("config/plant.toml", "config/plant.toml: not an MCAP file"),
        ("nowhere.mcap", "nowhere.mcap: No such file"),
    ] {
        let ended = command_line.run(&format!("plot {run}"));
        assert!(ended.code != Some(0) && ended.stderr.starts_with(said), "{}", ended.stderr);
    }
}
