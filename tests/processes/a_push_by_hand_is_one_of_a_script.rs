//! Goal: a push that is asked for while the robot is simulated does what the same push of a script does, bit for bit,
//! and is recorded with the numbers that such a script needs.

use std::time::Duration;

use halfstep_tests::command_line::CommandLine;
use interface::{PushOutcome, PushRequest};
use model::{Joint, Mechanism};
use record::{Recording, RunEvent, files_of};
use wire::{PushClient, PushError, PushReplyMessage, PushRequestMessage};

const PATIENCE: Duration = Duration::from_secs(300);

fn outcome(reply: &PushReplyMessage) -> PushOutcome {
    reply.checked().expect("a reply").outcome
}

#[test]
fn a_push_by_hand_repeats_as_a_script() {
    repeats_as_a_script("");
}

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn a_push_by_hand_repeats_as_a_script_in_mujoco() {
    repeats_as_a_script("--engine mujoco");
}

/// * `engine` – option by which the plant is moved
fn repeats_as_a_script(engine: &str) {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let words = "--lockstep --for 6s";
    let controller = command_line.start_here(&format!("controller {words} --out by_hand"));
    command_line.wait_for_controller();
    assert_eq!(
        PushClient::connect(command_line.wire_instance()).map(drop),
        Err(PushError::NoPlant { instance: command_line.instance().to_owned() })
    );
    let plant = command_line.start_here(&format!("plant {engine} {words} --out by_hand"));
    let client = loop {
        match PushClient::connect(command_line.wire_instance()) {
            Ok(client) => break client,
            Err(PushError::NoPlant { .. }) => std::thread::sleep(Duration::from_millis(1)),
            Err(error) => panic!("{error}"),
        }
    };
    let impulse = [2.0, 5.0, 0.0].into();
    let push = PushRequest { link: Mechanism::TRUNK, impulse, duration: 0.1 };
    let ask = |message: &PushRequestMessage| client.ask(message, PATIENCE).expect("an answer");
    let begun = ask(&(&push).into());
    assert_eq!(outcome(&begun), PushOutcome::Begun);
    assert_eq!(outcome(&ask(&(&PushRequest { duration: 1e3, ..push }).into())), PushOutcome::OutOfRange);
    assert_eq!(outcome(&ask(&PushRequestMessage { link: 3, ..(&push).into() })), PushOutcome::Invalid);
    assert_eq!([controller.finish().code, plant.finish().code], [Some(0); 2]);

    let mut recorded = Vec::new();
    for file in files_of(&command_line.folder().join("by_hand")).unwrap() {
        let mut recording = Recording::open(&file).unwrap();
        while let Some(event) = recording.next_event().unwrap() {
            if let RunEvent::Push(push) = event.event {
                recorded.push(push);
            }
        }
    }
    let [given] = recorded[..] else { panic!("{recorded:?}") };
    assert_eq!((given.link, given.start, given.duration), (16, begun.start, 0.1));
    let turned = f64::hypot(given.impulse[0], given.impulse[1]) - f64::hypot(2.0, 5.0);
    assert!(turned.abs() < 1e-9, "as the robot faced: {:?}", given.impulse);

    let link = Joint::from_number(given.link as u8).and_then(Joint::link_name).expect("a body");
    let script = format!(
        "[[push]]\nat_s = {:?}\nlasts_s = {:?}\nimpulse_n_s = {:?}\nlink = \"{link}\"\n",
        given.start, given.duration, given.impulse
    );
    std::fs::write(command_line.folder().join("script.toml"), script).unwrap();
    let walk = |out: &str, disturbed: &str| {
        let controller = command_line.start_here(&format!("controller {words} --out {out}"));
        let plant = command_line.start_here(&format!("plant {engine} {words} --out {out} {disturbed}"));
        assert_eq!([controller.finish().code, plant.finish().code], [Some(0); 2]);
        command_line.csv(out, "plant")
    };
    let by_hand = command_line.csv("by_hand", "plant");
    assert!(walk("by_script", "--disturbances script.toml") == by_hand, "the same push, the same bits");
    assert!(walk("without", "") != by_hand, "it does something");
}
