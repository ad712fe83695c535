//! Which instances of this user are running, and which processes take part in them.

use crate::shared_memory::Role;
use crate::{Instance, InstanceName, runtime_folder};

/// The processes of an instance, by what they are in it: their ids.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Participants {
    /// The controller.
    pub controller: Option<u32>,
    /// The plant.
    pub plant: Option<u32>,
    /// Those that send requests.
    pub operators: Vec<u32>,
    /// Those that hear reports.
    pub observers: Vec<u32>,
}

impl Instance {
    /// The processes that are connected, each once for each of its roles. What cannot be read counts as not connected.
    pub fn participants(&self) -> Participants {
        let of = |role| {
            let mut processes = self.processes(role);
            processes.dedup();
            processes
        };
        Participants {
            controller: of(Role::Controller).first().copied(),
            plant: of(Role::Plant).first().copied(),
            operators: of(Role::Operator),
            observers: of(Role::Observer),
        }
    }

    /// Whether a controller is connected.
    pub fn has_controller(&self) -> bool {
        !self.processes(Role::Controller).is_empty()
    }
}

/// The instances of this user whose controller is running, by name. What cannot be read counts as not running.
pub fn running_instances() -> Vec<InstanceName> {
    instances_with(Instance::has_controller)
}

/// The instances of this user whose controller or plant is running, by name. What cannot be read counts as not running.
pub fn instances_in_use() -> Vec<InstanceName> {
    instances_with(Instance::is_in_use)
}

fn instances_with(is_wanted: impl Fn(&Instance) -> bool) -> Vec<InstanceName> {
    let Ok(folders) = std::fs::read_dir(runtime_folder::of_user()) else { return Vec::new() };
    let names = folders.flatten().filter_map(|folder| folder.file_name().to_str()?.parse().ok());
    let is_found = |name: &InstanceName| Instance::new(name.as_str()).is_ok_and(|instance| is_wanted(&instance));
    let mut found: Vec<InstanceName> = names.filter(is_found).collect();
    found.sort();
    found
}
