//! Which instances of this user have a controller.

use crate::shared_memory::Role;
use crate::{Instance, InstanceName, runtime_folder};

/// The instances of this user whose controller is running, by name. What cannot be read counts as not running.
pub fn running_instances() -> Vec<InstanceName> {
    let Ok(folders) = std::fs::read_dir(runtime_folder::of_user()) else { return Vec::new() };
    let names = folders.flatten().filter_map(|folder| folder.file_name().to_str()?.parse().ok());
    let mut running: Vec<InstanceName> = names.filter(has_controller).collect();
    running.sort();
    running
}

fn has_controller(name: &InstanceName) -> bool {
    Instance::new(name.as_str()).is_ok_and(|instance| !instance.processes(Role::Controller).is_empty())
}
