//! A second controller is refused, and so is a second plant; instances do not see each other.

mod common;

use common::{MECHANISM, measurement, own_instance, request, setpoint};
use wire::{ConnectError, ControllerPorts, OperatorPorts, PlantPorts};

#[test]
fn a_second_controller_or_plant_is_refused_without_disturbing_the_first() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let mut plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    controller.setpoints.write(&setpoint(5));
    plant.measurements.write(&measurement(6));

    let error = ControllerPorts::connect(&instance, MECHANISM).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!(
            "another controller is already running on instance `{}`; \
             stop it or choose another instance (--instance NAME)",
            instance.name()
        )
    );
    let error = PlantPorts::connect(&instance, MECHANISM).unwrap_err();
    assert!(error.to_string().starts_with("another plant is already running on instance"), "{error}");

    assert_eq!(plant.setpoints.latest(), Some(setpoint(5)));
    assert_eq!(controller.measurements.latest(), Some(measurement(6)));

    drop(controller);
    let mut next = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    assert_eq!(plant.setpoints.latest(), Some(setpoint(5)), "the last message stays until the next is written");
    next.setpoints.write(&setpoint(0));
    assert_eq!(plant.setpoints.latest(), Some(setpoint(0)));
}

#[test]
fn a_new_controller_waits_for_the_old_one_to_disconnect() {
    let (instance, _leftovers) = own_instance();
    let controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    std::thread::scope(|threads| {
        let next = threads.spawn(|| ControllerPorts::connect(&instance, MECHANISM));
        drop(controller);
        assert!(next.join().unwrap().is_ok());
    });
}

#[test]
fn instances_do_not_see_each_other() {
    let (one, _leftovers) = own_instance();
    // A name that begins like the other's.
    let two = wire::Instance::new(&format!("{}-b", one.name())).unwrap();
    let _also = two.leftovers();

    let mut controllers = [&one, &two].map(|instance| ControllerPorts::connect(instance, MECHANISM).unwrap());
    let mut plants = [&one, &two].map(|instance| PlantPorts::connect(instance, MECHANISM).unwrap());
    controllers[0].setpoints.write(&setpoint(1));
    assert_eq!(plants[0].setpoints.latest(), Some(setpoint(1)));
    assert_eq!(plants[1].setpoints.latest(), None);

    let operator = OperatorPorts::connect(&two).unwrap();
    let _waiting = operator.requests.send(&request(0.1)).unwrap();
    assert!(controllers[0].requests.next_request().unwrap().is_none());
    assert!(controllers[1].requests.next_request().unwrap().is_some());

    // Everything of `one` goes, nothing of `two`.
    let [controller_of_one, controller_of_two] = controllers;
    let [plant_of_one, mut plant_of_two] = plants;
    drop((controller_of_one, controller_of_two, plant_of_one));
    one.remove_leftovers().unwrap();
    let mut controller = ControllerPorts::connect(&two, MECHANISM).unwrap();
    controller.setpoints.write(&setpoint(2));
    assert_eq!(plant_of_two.setpoints.latest(), Some(setpoint(2)));
}

#[test]
fn one_controller_and_one_plant_of_several_simultaneous_starts_succeed() {
    let (instance, _leftovers) = own_instance();
    let is_taken = |error: &ConnectError| matches!(error, ConnectError::AlreadyRunning { .. });
    std::thread::scope(|threads| {
        let controllers: Vec<_> =
            (0..3).map(|_| threads.spawn(|| ControllerPorts::connect(&instance, MECHANISM))).collect();
        let plants: Vec<_> = (0..3).map(|_| threads.spawn(|| PlantPorts::connect(&instance, MECHANISM))).collect();
        // All results are kept until the end, so that no second one can connect after a successful one has gone.
        let controllers: Vec<_> = controllers.into_iter().map(|thread| thread.join().unwrap()).collect();
        let plants: Vec<_> = plants.into_iter().map(|thread| thread.join().unwrap()).collect();
        assert_eq!(controllers.iter().flatten().count(), 1);
        assert_eq!(plants.iter().flatten().count(), 1);
        assert!(controllers.iter().filter_map(|end| end.as_ref().err()).all(is_taken));
        assert!(plants.iter().filter_map(|end| end.as_ref().err()).all(is_taken));
    });
}
