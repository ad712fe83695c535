//! All four services carry their messages, whichever end comes first, and nothing is left when all have gone.

mod common;

use common::{LONG, MECHANISM, eventually, files_of, measurement, own_instance, report, request, setpoint};
use wire::{
    AskError, ConnectError, ControllerEnd, Granted, ObserverEnd, OperatorEnd, PlantEnd, Reason, Reply, ReplyMessage,
};

#[test]
fn the_newest_setpoint_and_measurement_win() {
    for controller_first in [true, false] {
        let (instance, _leftovers) = own_instance();
        let connect_controller = || ControllerEnd::connect(&instance, MECHANISM).unwrap();
        let connect_plant = || PlantEnd::connect(&instance, MECHANISM).unwrap();
        let (mut controller, mut plant);
        if controller_first {
            controller = connect_controller();
            plant = connect_plant();
        } else {
            plant = connect_plant();
            controller = connect_controller();
        }
        assert_eq!(plant.setpoints.newest(), None);
        assert_eq!(controller.measurements.newest(), None);
        for tick in 0..5 {
            plant.measurements.write(&measurement(tick));
            assert_eq!(controller.measurements.newest(), Some(measurement(tick)));
            assert_eq!(controller.measurements.newest(), Some(measurement(tick)), "it can be read again");
            controller.setpoints.write(&setpoint(2 * tick));
            controller.setpoints.write(&setpoint(2 * tick + 1));
            assert_eq!(plant.setpoints.newest(), Some(setpoint(2 * tick + 1)), "the newest wins");
        }
    }
}

#[test]
fn each_request_gets_its_own_reply() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    let (console, script) = (OperatorEnd::connect(&instance).unwrap(), OperatorEnd::connect(&instance).unwrap());

    // Both ask 256 times before anybody answers.
    let ask = |operator: &OperatorEnd, from: u32| {
        (0..256).map(|turn| operator.requests.send(&request(f64::from(from + turn))).unwrap()).collect::<Vec<_>>()
    };
    let waiting = [ask(&console, 0), ask(&script, 1000)];
    assert_eq!(console.requests.send(&request(0.0)).unwrap_err(), AskError::TooMany { limit: 256 });
    assert!(waiting[0][0].poll().unwrap().is_none());

    let mut asked = Vec::new();
    while let Some(question) = controller.requests.next_request().unwrap() {
        asked.push(question);
    }
    assert_eq!(asked.len(), 512);
    // Answered in another order than asked.
    for (message, answer) in asked.into_iter().rev() {
        assert!(answer.reply(&reply_to(message.turn)));
    }
    for (waiting, first) in waiting.iter().zip([0, 1000]) {
        for (waiting, turn) in waiting.iter().zip(first..) {
            let reply = console.requests.wait(waiting, LONG).unwrap();
            assert_eq!(reply, reply_to(f64::from(turn)));
        }
    }
    drop(waiting);
    assert!(console.requests.send(&request(0.0)).is_ok(), "answers that were read make room for new questions");
}

fn reply_to(turn: f64) -> ReplyMessage {
    let granted = Granted { turn, speed: 1.0, extension: 0.0, intent: None };
    ReplyMessage::from(&Reply::refused(Reason::NoWayBack, 7, granted))
}

#[test]
fn observers_hear_every_report_and_lose_the_oldest_when_they_sleep() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    let mut observers = [ObserverEnd::connect(&instance).unwrap(), ObserverEnd::connect(&instance).unwrap()];
    for tick in 0..3 {
        assert_eq!(controller.reports.publish(&report(tick)), Ok(2));
    }
    for observer in &mut observers {
        for tick in 0..3 {
            assert_eq!(observer.reports.next_report().unwrap(), Some(report(tick)));
        }
        assert_eq!(observer.reports.next_report().unwrap(), None);
    }
    for tick in 3..103 {
        controller.reports.publish(&report(tick)).unwrap();
    }
    assert_eq!(observers[0].reports.next_report().unwrap().unwrap().tick, 103 - 64);
}

#[test]
fn ends_and_their_parts_move_to_other_threads() {
    let (instance, _leftovers) = own_instance();
    let ControllerEnd { mut setpoints, mut measurements, mut requests, mut reports } =
        ControllerEnd::connect(&instance, MECHANISM).unwrap();
    let mut plant = PlantEnd::connect(&instance, MECHANISM).unwrap();
    let mut observer = ObserverEnd::connect(&instance).unwrap();
    let operator = OperatorEnd::connect(&instance).unwrap();
    const TICKS: u64 = 200;

    std::thread::scope(|threads| {
        // Lockstep: each waits for the other's tick.
        threads.spawn(move || {
            for tick in 0..TICKS {
                eventually("a measurement", || measurements.newest().filter(|message| message.tick == tick));
                setpoints.write(&setpoint(tick));
            }
        });
        threads.spawn(move || {
            for tick in 0..TICKS {
                plant.measurements.write(&measurement(tick));
                let newest = eventually("a setpoint", || plant.setpoints.newest().filter(|m| m.tick == tick));
                assert_eq!(newest, setpoint(tick), "a message is never torn");
            }
        });
        threads.spawn(move || {
            for _ in 0..2 {
                let (_, answer) = eventually("a request", || requests.next_request().unwrap());
                reports.publish(&report(1)).unwrap();
                answer.reply(&reply_to(0.0));
            }
            // The last answer has been read when the operator says goodbye with a question nobody answers.
            eventually("a goodbye", || requests.next_request().unwrap());
        });
        threads.spawn(move || {
            operator.requests.ask(&request(0.0), LONG).unwrap();
            eventually("a report", || observer.reports.next_report().unwrap());
            operator.requests.ask(&request(0.0), LONG).unwrap();
            let goodbye = operator.requests.send(&request(0.0)).unwrap();
            eventually("the end", || goodbye.poll().err());
        });
    });
}

#[test]
fn without_a_controller_nobody_can_ask_or_listen() {
    let (instance, _leftovers) = own_instance();
    let text = format!(
        "no controller is running on instance `{0}`; start one with `halfstep controller --instance {0}`",
        instance.name()
    );
    let error = |error: ConnectError| error.to_string();
    assert_eq!(OperatorEnd::connect(&instance).map_err(error).unwrap_err(), text);
    assert_eq!(ObserverEnd::connect(&instance).map_err(error).unwrap_err(), text);

    let _plant = PlantEnd::connect(&instance, MECHANISM).unwrap();
    assert_eq!(OperatorEnd::connect(&instance).map_err(error).unwrap_err(), text, "a plant is no controller");

    let controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    let operator = OperatorEnd::connect(&instance).unwrap();
    let _observer = ObserverEnd::connect(&instance).unwrap();
    let waiting = operator.requests.send(&request(0.0)).unwrap();
    drop(controller);
    let gone = AskError::NoController { instance: instance.name().to_string() };
    assert_eq!(operator.requests.wait(&waiting, LONG).unwrap_err(), gone, "it left without an answer");
    assert_eq!(operator.requests.send(&request(0.0)).unwrap_err(), gone);
    assert_eq!(OperatorEnd::connect(&instance).map_err(error).unwrap_err(), text, "an operator is no controller");

    let mut controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    let waiting = operator.requests.send(&request(0.5)).unwrap();
    let (message, answer) = controller.requests.next_request().unwrap().unwrap();
    assert_eq!(message.turn, 0.5, "the operator finds the next controller");
    drop(answer);
    assert_eq!(operator.requests.wait(&waiting, LONG).unwrap_err(), AskError::Dropped);
}

#[test]
fn nothing_is_left_when_all_have_gone() {
    let (instance, leftovers) = own_instance();
    {
        let _controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
        let _plant = PlantEnd::connect(&instance, MECHANISM).unwrap();
        let before = files_of(&instance);
        instance.remove_leftovers().unwrap();
        assert_eq!(files_of(&instance).len(), before.len(), "what is in use stays");
    }
    drop(leftovers);
    assert_eq!(files_of(&instance), [""; 0]);
}
