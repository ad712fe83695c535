//! A killed process does not stop the next: neither when all were killed, nor when the other side goes on.
//!
//! The process to be killed is the program `killed_process`, which writes one message as controller or plant.

mod common;

use std::fs::{DirBuilder, OpenOptions};
use std::io::{BufRead, BufReader};
use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use common::{
    LONG, MECHANISM, eventually, files_of, measurement, own_instance, report, request, runtime_folder, setpoint,
};
use wire::{ControllerPorts, Instance, ObserverPorts, OperatorPorts, PlantPorts, RequestError, WRITER_SLOTS};

/// A child process that has written its message.
struct Victim(Child);

impl Victim {
    fn start(instance: &Instance, role: &str, tick: u64) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_killed_process"))
            .args([instance.name().as_str(), role, &tick.to_string()])
            .env("XDG_RUNTIME_DIR", runtime_folder(instance))
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        assert!(lines.map_while(Result::ok).any(|line| line == "ready"), "the {role} could not start");
        Self(child)
    }

    /// Sends SIGKILL: the process has no chance to clean up.
    fn kill(mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}

#[test]
fn leftovers_of_killed_processes_do_not_stop_the_next_start() {
    let (instance, leftovers) = own_instance();
    let (controller, plant) = (Victim::start(&instance, "controller", 1), Victim::start(&instance, "plant", 1));
    controller.kill();
    plant.kill();
    assert!(files_of(&instance).len() > 4, "there is something to clean up");

    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    assert_eq!(controller.measurements.latest(), None, "messages of killed processes are gone");
    drop((controller, plant, leftovers));
    assert_eq!(files_of(&instance), [""; 0]);
}

#[test]
fn leftovers_of_killed_processes_can_be_removed() {
    let (instance, _leftovers) = own_instance();
    Victim::start(&instance, "controller", 1).kill();
    assert!(!files_of(&instance).is_empty());
    instance.remove_leftovers().unwrap();
    assert_eq!(files_of(&instance), [""; 0]);
}

#[test]
fn a_plant_keeps_running_with_the_next_controller_after_a_kill() {
    let (instance, _leftovers) = own_instance();
    let mut plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    for tick in 0..5 {
        let controller = Victim::start(&instance, "controller", tick);
        assert_eq!(plant.setpoints.latest(), Some(setpoint(tick)));
        controller.kill();
        assert_eq!(plant.setpoints.latest(), Some(setpoint(tick)), "the last message of a killed process stays");
    }
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    controller.setpoints.write(&setpoint(0));
    assert_eq!(plant.setpoints.latest(), Some(setpoint(0)));
    drop(controller);
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    controller.setpoints.write(&setpoint(1));
    assert_eq!(plant.setpoints.latest(), Some(setpoint(1)), "also after a clean exit");
    plant.measurements.write(&measurement(9));
    assert_eq!(controller.measurements.latest(), Some(measurement(9)));
}

#[test]
fn a_controller_keeps_running_with_the_next_plant_after_a_kill() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    for tick in 0..3 {
        let plant = Victim::start(&instance, "plant", tick);
        assert_eq!(controller.measurements.latest(), Some(measurement(tick)));
        plant.kill();
    }
}

#[test]
fn a_blackboard_without_free_slots_is_refused_with_a_remedy() {
    let (instance, _leftovers) = own_instance();
    let mut plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    for tick in 0..WRITER_SLOTS {
        Victim::start(&instance, "controller", tick).kill();
    }
    assert_eq!(plant.setpoints.latest(), Some(setpoint(WRITER_SLOTS - 1)));
    let text = ControllerPorts::connect(&instance, MECHANISM).unwrap_err().to_string();
    assert!(text.contains("64 processes that wrote to it were killed"), "{text}");
    drop(plant);
    assert!(ControllerPorts::connect(&instance, MECHANISM).is_ok());
}

#[test]
fn operators_and_observers_notice_a_killed_controller_and_find_the_next() {
    let (instance, _leftovers) = own_instance();
    let victim = Victim::start(&instance, "controller", 0);
    let operator = OperatorPorts::connect(&instance).unwrap();
    let mut observer = ObserverPorts::connect(&instance).unwrap();
    let waiting = operator.requests.send(&request(0.1)).unwrap();
    victim.kill();
    let gone = RequestError::NoController { instance: instance.name().to_string() };
    assert_eq!(operator.requests.wait(&waiting, LONG).unwrap_err(), gone);
    drop(waiting);

    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let _waiting = operator.requests.send(&request(0.2)).unwrap();
    let (message, _answer) = eventually("a request", || controller.requests.next_request().unwrap());
    assert_eq!(message.turn, 0.2);
    assert_eq!(controller.reports.publish(&report(3)), Ok(1));
    assert_eq!(eventually("a report", || observer.reports.next_report().unwrap()), report(3));
}

/// Files that a process was making when it was killed: iceoryx2 waits for them without end.
#[test]
fn half_made_files_of_killed_processes_do_not_stop_the_next_start() {
    let (instance, _leftovers) = own_instance();
    let controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let names: Vec<_> = files_of(&instance).into_iter().filter(|name| name.starts_with("halfstep.")).collect();
    drop(controller);
    instance.remove_leftovers().unwrap();
    for name in names {
        DirBuilder::new().mode(0o700).recursive(true).create(instance.folder()).unwrap();
        let half_made = Path::new("/dev/shm").join(&name);
        OpenOptions::new().write(true).create_new(true).mode(0o200).open(half_made).unwrap();
        let controller = ControllerPorts::connect(&instance, MECHANISM);
        assert!(controller.is_ok(), "{name}: {controller:?}");
        drop(controller);
        instance.remove_leftovers().unwrap();
    }
}
