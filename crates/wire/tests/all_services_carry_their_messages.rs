//! All services carry their messages, in either start order, and no file is left at the end.

mod common;

use common::{LONG, MECHANISM, eventually, files_of, measurement, own_instance, report, request, setpoint};
use interface::{Command, Reason, Reply};
use wire::{
    ConnectError, ControllerPorts, MAX_UNANSWERED, ObserverPorts, OperatorPorts, PlantPorts, PushClient, PushError,
    PushReplyMessage, PushRequestMessage, ReplyMessage, RequestError, SpectatorPorts,
};

#[test]
fn readers_get_the_latest_setpoint_and_measurement() {
    for controller_first in [true, false] {
        let (instance, _leftovers) = own_instance();
        let connect_controller = || ControllerPorts::connect(&instance, MECHANISM).unwrap();
        let connect_plant = || PlantPorts::connect(&instance, MECHANISM).unwrap();
        let (mut controller, mut plant);
        if controller_first {
            controller = connect_controller();
            plant = connect_plant();
        } else {
            plant = connect_plant();
            controller = connect_controller();
        }
        assert_eq!(plant.setpoints.latest(), None);
        assert_eq!(controller.measurements.latest(), None);
        for tick in 0..5 {
            plant.measurements.write(&measurement(tick));
            assert_eq!(controller.measurements.latest(), Some(measurement(tick)));
            assert_eq!(controller.measurements.latest(), Some(measurement(tick)), "it can be read again");
            controller.setpoints.write(&setpoint(2 * tick));
            controller.setpoints.write(&setpoint(2 * tick + 1));
            assert_eq!(plant.setpoints.latest(), Some(setpoint(2 * tick + 1)), "the newest wins");
        }
    }
}

#[test]
fn a_spectator_sees_measurements_and_reports_of_any_robot() {
    let (instance, _leftovers) = own_instance();
    let instance = instance.with_rate_hz(250).with_lockstep(true);
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let mut plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    // It knows neither the robot nor the rate nor the clock.
    let name = instance.clone().with_rate_hz(1000).with_lockstep(false);
    let mut spectator = SpectatorPorts::connect(&name).unwrap();
    assert_eq!((spectator.mechanism, spectator.is_lockstep), (MECHANISM, true));
    assert_eq!(spectator.reports.rate_hz(), 250);
    assert_eq!(spectator.measurements.latest(), None);
    plant.measurements.write(&measurement(3));
    controller.reports.publish(&report(3)).unwrap();
    assert_eq!(spectator.measurements.latest(), Some(measurement(3)));
    assert_eq!(spectator.reports.next_report().unwrap().map(|report| report.tick), Some(3));
}

#[test]
fn each_push_gets_its_own_reply() {
    let (instance, _leftovers) = own_instance();
    assert!(matches!(PushClient::connect(&instance), Err(PushError::NoPlant { .. })));
    let mut plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    let clients = [0, 1].map(|_| PushClient::connect(&instance).unwrap());
    let push = |link| PushRequestMessage { link, impulse: [1.0, 2.0, 3.0], duration: 0.1 };
    std::thread::scope(|threads| {
        for (client, link) in clients.iter().zip([3, 5]) {
            threads.spawn(move || {
                let reply = client.ask(&push(link), LONG).unwrap();
                assert_eq!(reply, PushReplyMessage { outcome: 0, start: link as f64 });
            });
        }
        for _ in 0..2 {
            let (asked, responder) = eventually("a push", || plant.pushes.next_push().unwrap());
            assert_eq!(asked, push(asked.link));
            assert!(responder.reply(&PushReplyMessage { outcome: 0, start: asked.link as f64 }));
        }
    });
    drop(plant);
    assert!(matches!(clients[0].ask(&push(1), LONG), Err(PushError::NoPlant { .. })));
}

#[test]
fn each_request_gets_its_own_reply() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let (console, script) = (OperatorPorts::connect(&instance).unwrap(), OperatorPorts::connect(&instance).unwrap());

    // Both send as many requests as they can before the first reply.
    let ask = |operator: &OperatorPorts, from: u32| {
        (0..MAX_UNANSWERED as u32)
            .map(|turn| operator.requests.send(&request(f64::from(from + turn))).unwrap())
            .collect::<Vec<_>>()
    };
    let waiting = [ask(&console, 0), ask(&script, 1000)];
    assert_eq!(console.requests.send(&request(0.0)).unwrap_err(), RequestError::TooMany { limit: MAX_UNANSWERED });
    assert!(waiting[0][0].poll().unwrap().is_none());

    let mut asked = Vec::new();
    while let Some(question) = controller.requests.next_request().unwrap() {
        asked.push(question);
    }
    assert_eq!(asked.len(), 2 * MAX_UNANSWERED);
    // Replies in another order than the requests.
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
    assert!(console.requests.send(&request(0.0)).is_ok(), "replies that were read make room for new requests");
}

fn reply_to(turn: f64) -> ReplyMessage {
    let granted = Command { turn, ..Command::NOMINAL };
    ReplyMessage::from(&Reply::refused(Reason::CannotRestart, 7, granted, None))
}

#[test]
fn observers_receive_every_report_and_lose_the_oldest_when_slow() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let mut observers = [ObserverPorts::connect(&instance).unwrap(), ObserverPorts::connect(&instance).unwrap()];
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
fn ports_may_move_to_other_threads() {
    let (instance, _leftovers) = own_instance();
    let ControllerPorts { mut setpoints, mut measurements, mut requests, mut reports } =
        ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let mut plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    let mut observer = ObserverPorts::connect(&instance).unwrap();
    let operator = OperatorPorts::connect(&instance).unwrap();
    const TICKS: u64 = 200;

    std::thread::scope(|threads| {
        // Lockstep: each waits for the other's tick.
        threads.spawn(move || {
            for tick in 0..TICKS {
                eventually("a measurement", || measurements.latest().filter(|message| message.tick == tick));
                setpoints.write(&setpoint(tick));
            }
        });
        threads.spawn(move || {
            for tick in 0..TICKS {
                plant.measurements.write(&measurement(tick));
                let newest = eventually("a setpoint", || plant.setpoints.latest().filter(|m| m.tick == tick));
                assert_eq!(newest, setpoint(tick), "a message is never torn");
            }
        });
        threads.spawn(move || {
            for _ in 0..2 {
                let (_, answer) = eventually("a request", || requests.next_request().unwrap());
                reports.publish(&report(1)).unwrap();
                answer.reply(&reply_to(0.0));
            }
            // The operator has read the last reply when it sends one more request, which stays without a reply.
            eventually("the last request", || requests.next_request().unwrap());
        });
        threads.spawn(move || {
            operator.requests.ask(&request(0.0), LONG).unwrap();
            eventually("a report", || observer.reports.next_report().unwrap());
            operator.requests.ask(&request(0.0), LONG).unwrap();
            let last = operator.requests.send(&request(0.0)).unwrap();
            eventually("the end", || last.poll().err());
        });
    });
}

#[test]
fn operators_and_observers_are_refused_without_a_controller() {
    let (instance, _leftovers) = own_instance();
    let text = format!(
        "no controller is running on instance `{0}`; start one with `halfstep controller --instance {0}`",
        instance.name()
    );
    let error = |error: ConnectError| error.to_string();
    assert_eq!(OperatorPorts::connect(&instance).map_err(error).unwrap_err(), text);
    assert_eq!(ObserverPorts::connect(&instance).map_err(error).unwrap_err(), text);

    let _plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    assert_eq!(OperatorPorts::connect(&instance).map_err(error).unwrap_err(), text, "a plant is no controller");

    let controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let operator = OperatorPorts::connect(&instance).unwrap();
    let _observer = ObserverPorts::connect(&instance).unwrap();
    let waiting = operator.requests.send(&request(0.0)).unwrap();
    drop(controller);
    let gone = RequestError::NoController { instance: instance.name().to_string() };
    assert_eq!(operator.requests.wait(&waiting, LONG).unwrap_err(), gone, "it disconnected without a reply");
    assert_eq!(operator.requests.send(&request(0.0)).unwrap_err(), gone);
    assert_eq!(OperatorPorts::connect(&instance).map_err(error).unwrap_err(), text, "an operator is no controller");

    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let waiting = operator.requests.send(&request(0.5)).unwrap();
    let (message, answer) = controller.requests.next_request().unwrap().unwrap();
    assert_eq!(message.turn, 0.5, "the operator finds the next controller");
    drop(answer);
    assert_eq!(operator.requests.wait(&waiting, LONG).unwrap_err(), RequestError::Dropped);
}

#[test]
fn no_file_is_left_once_all_processes_have_disconnected() {
    let (instance, leftovers) = own_instance();
    {
        let _controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
        let _plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
        let before = files_of(&instance);
        instance.remove_leftovers().unwrap();
        assert_eq!(files_of(&instance).len(), before.len(), "what is in use stays");
    }
    drop(leftovers);
    assert_eq!(files_of(&instance), [""; 0]);
}
