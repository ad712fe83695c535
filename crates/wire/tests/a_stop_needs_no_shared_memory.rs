//! A stop reaches the controller through a socket: no place among the operators is needed, no lock, no shared memory.

mod common;

use std::time::Duration;

use common::{LONG, MECHANISM, eventually, own_instance, request, runtime_folder};
use interface::{Intent, Reply, Request, Source};
use wire::{
    ConnectError, ControllerPorts, Instance, MAX_OPERATORS, OperatorPorts, PROTOCOL, ReplyMessage, RequestError,
    RequestMessage, UrgentClient,
};

fn stop() -> RequestMessage {
    (&Request { intent: Some(Intent::Stop), ..Request::new(Source::Console) }).into()
}

fn reply() -> ReplyMessage {
    (&Reply::refused(interface::Reason::Fallen, 7, interface::Command::NOMINAL, None)).into()
}

#[test]
fn a_stop_gets_through_when_all_places_are_taken() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let _operators: Vec<_> = (0..MAX_OPERATORS).map(|_| OperatorPorts::connect(&instance).unwrap()).collect();
    let text = OperatorPorts::connect(&instance).unwrap_err().to_string();
    let own = std::process::id();
    assert!(text.contains("32 operators are connected"), "{text}");
    assert!(text.contains(&format!("(processes {own}, {own}")) && text.contains("send stop"), "{text}");

    // Nor does it wait for a process that hangs while it connects.
    let hangs = std::fs::File::open(instance.folder().join("turn")).unwrap();
    hangs.lock().unwrap();
    let asks = {
        let instance = instance.clone();
        std::thread::spawn(move || UrgentClient::connect(&instance).unwrap().stop(&stop(), LONG))
    };
    let (message, responder) = eventually("the stop", || controller.requests.next_request().unwrap());
    assert_eq!(message, stop());
    assert!(responder.is_wanted() && responder.reply(&reply()));
    assert_eq!(asks.join().unwrap(), Ok(reply()));
}

#[test]
fn the_socket_takes_stops_of_this_version_only() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let short = Duration::from_millis(20);
    let client = UrgentClient::connect(&instance).unwrap();
    let later = RequestMessage { not_before: 5, ..stop() };
    for other in [request(0.1), later, RequestMessage { source: 77, ..stop() }] {
        assert!(matches!(client.stop(&other, short), Err(RequestError::TimedOut { .. })));
    }
    let newer = UrgentClient::connect(&instance.clone().with_protocol(PROTOCOL + 1)).unwrap();
    assert!(matches!(newer.stop(&stop(), short), Err(RequestError::TimedOut { .. })));
    assert!(controller.requests.next_request().unwrap().is_none());
}

#[test]
fn without_a_controller_nothing_is_created() {
    let (instance, _leftovers) = own_instance();
    let none = |error: ConnectError| assert!(matches!(error, ConnectError::NoController { .. }), "{error}");
    none(UrgentClient::connect(&instance).unwrap_err());
    none(OperatorPorts::connect(&instance).unwrap_err());
    assert!(!instance.folder().exists());

    let controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let client = UrgentClient::connect(&instance).unwrap();
    drop(controller);
    let gone = RequestError::NoController { instance: instance.name().to_string() };
    assert_eq!(client.stop(&stop(), LONG), Err(gone));
    none(UrgentClient::connect(&instance).unwrap_err());
}

#[test]
fn a_folder_with_a_long_path_has_a_socket_too() {
    let (outer, _leftovers) = own_instance();
    let base = runtime_folder(&outer).join("x".repeat(80));
    std::os::unix::fs::DirBuilderExt::mode(&mut std::fs::DirBuilder::new(), 0o700).create(&base).unwrap();
    let instance = Instance::new_in("long", &base).unwrap();
    let _removed = instance.leftovers();
    let _controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    assert!(UrgentClient::connect(&instance).is_ok());
}
