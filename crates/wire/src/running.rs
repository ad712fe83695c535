//! Which instances of this user have a controller.

use iceoryx2::node::NodeView;
use iceoryx2::prelude::{CallbackProgression, Node, NodeState};

use crate::{Instance, InstanceName, Ipc, runtime_folder};

/// The name that a controller's process has in its instance.
const CONTROLLER: &str = "controller";

/// The instances of this user whose controller is running, by name. What cannot be read counts as not running.
pub fn running_instances() -> Vec<InstanceName> {
    let Ok(folders) = std::fs::read_dir(runtime_folder::of_user()) else { return Vec::new() };
    let names = folders.flatten().filter_map(|folder| folder.file_name().to_str()?.parse().ok());
    let mut running: Vec<InstanceName> = names.filter(has_controller).collect();
    running.sort();
    running
}

fn has_controller(name: &InstanceName) -> bool {
    let Ok(instance) = Instance::new(name.as_str()) else { return false };
    let mut is_running = false;
    // If they cannot be listed, none was found.
    let _ = Node::<Ipc>::list(instance.config(), |state| {
        if let NodeState::Alive(process) = state
            && process.details().as_ref().is_some_and(|details| details.name().as_str() == CONTROLLER)
        {
            is_running = true;
        }
        CallbackProgression::Continue
    });
    is_running
}
