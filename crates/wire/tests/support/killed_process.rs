//! The process that tests kill: `killed_process INSTANCE controller|plant TICK`. Connects, writes one message, prints
//! `ready`, and waits to be killed.

#[path = "../common/mod.rs"]
mod common;

use common::{LONG, MECHANISM, measurement, setpoint};
use wire::{ControllerPorts, Instance, PlantPorts};

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, name, role, tick] = arguments.as_slice() else { panic!("three arguments are needed: {arguments:?}") };
    let (instance, tick) = (Instance::new(name).unwrap(), tick.parse().unwrap());
    if role == "controller" {
        let mut ports = ControllerPorts::connect(&instance, MECHANISM).unwrap();
        ports.setpoints.write(&setpoint(tick));
        wait_to_be_killed();
    } else {
        let mut ports = PlantPorts::connect(&instance, MECHANISM).unwrap();
        ports.measurements.write(&measurement(tick));
        wait_to_be_killed();
    }
}

fn wait_to_be_killed() {
    println!("ready");
    std::thread::sleep(10 * LONG);
}
