//! A killed process does not stop the next: neither when all were killed, nor when the other side goes on.
//!
//! The process to be killed is this test program itself, started again with the instance's name in its environment.

mod common;

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

use common::{LONG, MECHANISM, eventually, files_of, measurement, own_instance, report, request, setpoint};
use wire::{AskError, ControllerEnd, Instance, NEWEST_SLOTS, ObserverEnd, OperatorEnd, PlantEnd};

const INSTANCE: &str = "HALFSTEP_TEST_INSTANCE";
const ROLE: &str = "HALFSTEP_TEST_ROLE";
const TICK: &str = "HALFSTEP_TEST_TICK";

/// Not a test of its own: what the child process does. Writes one message, says so, and waits to be killed.
#[test]
fn the_process_to_be_killed() {
    let Ok(name) = std::env::var(INSTANCE) else { return };
    let instance = Instance::new(&name).unwrap();
    let tick = std::env::var(TICK).unwrap().parse().unwrap();
    let mut ends: (Option<ControllerEnd>, Option<PlantEnd>) = (None, None);
    if std::env::var(ROLE).unwrap() == "controller" {
        let end = ends.0.insert(ControllerEnd::connect(&instance, MECHANISM).unwrap());
        end.setpoints.write(&setpoint(tick));
    } else {
        let end = ends.1.insert(PlantEnd::connect(&instance, MECHANISM).unwrap());
        end.measurements.write(&measurement(tick));
    }
    println!("\nready");
    std::thread::sleep(10 * LONG);
}

/// A child process that has written its message.
struct Victim(Child);

impl Victim {
    fn start(instance: &Instance, role: &str, tick: u64) -> Self {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "the_process_to_be_killed", "--nocapture"])
            .env(INSTANCE, instance.name().as_str())
            .env(ROLE, role)
            .env(TICK, tick.to_string())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        assert!(lines.map_while(Result::ok).any(|line| line == "ready"), "the {role} could not start");
        Self(child)
    }

    /// SIGKILL: it has no chance to say goodbye.
    fn kill(mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}

#[test]
fn leftovers_of_the_dead_do_not_stop_the_next_start() {
    let (instance, leftovers) = own_instance();
    let (controller, plant) = (Victim::start(&instance, "controller", 1), Victim::start(&instance, "plant", 1));
    controller.kill();
    plant.kill();
    assert!(files_of(&instance).len() > 4, "there is something to clean up");

    let mut controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    let plant = PlantEnd::connect(&instance, MECHANISM).unwrap();
    assert_eq!(controller.measurements.newest(), None, "the dead are not heard");
    drop((controller, plant, leftovers));
    assert_eq!(files_of(&instance), [""; 0]);
}

#[test]
fn leftovers_of_the_dead_can_be_removed() {
    let (instance, _leftovers) = own_instance();
    Victim::start(&instance, "controller", 1).kill();
    assert!(!files_of(&instance).is_empty());
    instance.remove_leftovers().unwrap();
    assert_eq!(files_of(&instance), [""; 0]);
}

#[test]
fn a_plant_goes_on_with_the_next_controller() {
    let (instance, _leftovers) = own_instance();
    let mut plant = PlantEnd::connect(&instance, MECHANISM).unwrap();
    for tick in 0..5 {
        let controller = Victim::start(&instance, "controller", tick);
        assert_eq!(plant.setpoints.newest(), Some(setpoint(tick)));
        controller.kill();
        assert_eq!(plant.setpoints.newest(), Some(setpoint(tick)), "the last word of the dead stays");
    }
    let mut controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    controller.setpoints.write(&setpoint(0));
    assert_eq!(plant.setpoints.newest(), Some(setpoint(0)));
    drop(controller);
    let mut controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    controller.setpoints.write(&setpoint(1));
    assert_eq!(plant.setpoints.newest(), Some(setpoint(1)), "also after one that left in peace");
    plant.measurements.write(&measurement(9));
    assert_eq!(controller.measurements.newest(), Some(measurement(9)));
}

#[test]
fn a_controller_goes_on_with_the_next_plant() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    for tick in 0..3 {
        let plant = Victim::start(&instance, "plant", tick);
        assert_eq!(controller.measurements.newest(), Some(measurement(tick)));
        plant.kill();
    }
}

#[test]
fn a_reader_that_outlives_too_many_writers_says_so() {
    let (instance, _leftovers) = own_instance();
    let mut plant = PlantEnd::connect(&instance, MECHANISM).unwrap();
    for tick in 0..NEWEST_SLOTS {
        Victim::start(&instance, "controller", tick).kill();
    }
    assert_eq!(plant.setpoints.newest(), Some(setpoint(NEWEST_SLOTS - 1)));
    let text = ControllerEnd::connect(&instance, MECHANISM).unwrap_err().to_string();
    assert!(text.contains("64 processes that wrote to it were killed"), "{text}");
    drop(plant);
    assert!(ControllerEnd::connect(&instance, MECHANISM).is_ok());
}

#[test]
fn operators_and_observers_notice_and_find_the_next_controller() {
    let (instance, _leftovers) = own_instance();
    let victim = Victim::start(&instance, "controller", 0);
    let operator = OperatorEnd::connect(&instance).unwrap();
    let mut observer = ObserverEnd::connect(&instance).unwrap();
    let waiting = operator.requests.send(&request(0.1)).unwrap();
    victim.kill();
    let gone = AskError::NoController { instance: instance.name().to_string() };
    assert_eq!(operator.requests.wait(&waiting, LONG).unwrap_err(), gone);
    drop(waiting);

    let mut controller = ControllerEnd::connect(&instance, MECHANISM).unwrap();
    let _waiting = operator.requests.send(&request(0.2)).unwrap();
    let (message, _answer) = eventually("a request", || controller.requests.next_request().unwrap());
    assert_eq!(message.turn, 0.2);
    assert_eq!(controller.reports.publish(&report(3)), Ok(1));
    assert_eq!(eventually("a report", || observer.reports.next_report().unwrap()), report(3));
}
