//! The next start of anything removes what killed processes of any instance have left; the living lose nothing.

mod common;

use std::fs::{self, DirBuilder};
use std::os::unix::fs::DirBuilderExt;
use std::path::PathBuf;

use common::{MECHANISM, files_of, own_instance, runtime_folder};
use wire::{ControllerPorts, Instance, OperatorPorts, PlantPorts};

/// Another instance in the same runtime folder.
fn beside(instance: &Instance, name: &str) -> Instance {
    Instance::new_in(name, runtime_folder(instance)).unwrap()
}

/// Files in shared memory as a process leaves them that was killed.
fn leave_in_memory(instance: &Instance) -> PathBuf {
    let file = PathBuf::from(format!("/dev/shm/{}left", instance.prefix()));
    fs::write(&file, "left").unwrap();
    file
}

/// The folder of an instance, as its first process makes it.
fn create_folder(instance: &Instance) {
    DirBuilder::new().mode(0o700).recursive(true).create(instance.folder()).unwrap();
}

#[test]
fn the_next_start_sweeps_all_instances_without_a_process() {
    let (instance, _leftovers) = own_instance();
    let (dead, bare, alive) = (beside(&instance, "dead"), beside(&instance, "bare"), beside(&instance, "alive"));
    let _living = PlantPorts::connect(&alive, MECHANISM).unwrap();
    let of_the_living = files_of(&alive);
    create_folder(&dead);
    fs::write(dead.folder().join("anything"), "").unwrap();
    leave_in_memory(&dead);
    // Somebody has removed the folder only.
    leave_in_memory(&bare);

    let controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    assert_eq!(files_of(&dead), [""; 0]);
    assert_eq!(files_of(&bare), [""; 0]);
    assert_eq!(files_of(&alive), of_the_living);

    drop(controller);
    let _plant = PlantPorts::connect(&alive.with_rate_hz(1000), MECHANISM).unwrap_err();
}

#[test]
fn an_instance_in_the_making_is_not_swept() {
    let (instance, _leftovers) = own_instance();
    let making = beside(&instance, "making");
    create_folder(&making);
    let lock = fs::File::create(making.folder().join("turn")).unwrap();
    lock.lock().unwrap();
    let file = leave_in_memory(&making);
    let _controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    assert!(file.exists());
    drop(lock);
    making.remove_leftovers().unwrap();
    assert!(!file.exists());
}

#[test]
fn a_living_process_keeps_its_memory_when_its_folder_is_removed() {
    let (instance, _leftovers) = own_instance();
    let alive = beside(&instance, "alive");
    let _living = PlantPorts::connect(&alive, MECHANISM).unwrap();
    let in_memory = files_of(&alive).len() - 1;
    fs::remove_dir_all(alive.folder()).unwrap();
    let _controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    assert_eq!(files_of(&alive).iter().filter(|file| file.starts_with("halfstep.")).count(), in_memory);
}

#[test]
fn files_of_an_instance_of_the_same_name_elsewhere_are_named_and_kept() {
    let (instance, _leftovers) = own_instance();
    let (elsewhere, _others) = own_instance();
    let one = beside(&instance, "same");
    let other = beside(&elsewhere, "same");
    let _living = ControllerPorts::connect(&other, MECHANISM).unwrap();
    let text = OperatorPorts::connect(&one).unwrap_err().to_string();
    assert!(text.contains("with another XDG_RUNTIME_DIR"), "{text}");
    one.remove_leftovers().unwrap();
    assert!(OperatorPorts::connect(&other).is_ok());
}

#[test]
fn who_leaves_last_leaves_nothing() {
    let (instance, _leftovers) = own_instance();
    let guards = [instance.leftovers(), instance.leftovers()];
    let controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    let [first, last] = guards;
    drop(controller);
    drop(first);
    assert!(!files_of(&instance).is_empty());
    drop(plant);
    drop(last);
    assert_eq!(files_of(&instance), [""; 0]);
}
