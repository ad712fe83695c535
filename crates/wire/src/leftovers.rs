//! What dead processes have left behind of an instance, and its removal.
//!
//! Whoever leaves an instance last removes its files. Processes that were killed cannot: their instance is swept by the
//! next controller, plant or walk that this user starts, whatever its own instance is called. Only instances without a
//! process are swept, under the lock that every process takes to connect: so none is removed while it is made.

use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::Path;
use std::time::Duration;

use iceoryx2::prelude::{CallbackProgression, Node, NodeState};
use rustix::process::getuid;

use crate::connect_lock::ConnectLock;
use crate::instance::folder_hash;
use crate::{ConnectError, Instance, Ipc, shared_memory};

/// How long a process that leaves waits for others that connect: they are there then, and nothing is to be removed.
const PATIENCE: Duration = Duration::from_secs(1);

impl Instance {
    /// Removes everything that former processes have left behind. While any process is connected, only the leftovers of
    /// dead processes are removed. Too slow for the control loop.
    ///
    /// # Errors
    /// The folder of the instance cannot be read or removed.
    pub fn remove_leftovers(&self) -> Result<(), ConnectError> {
        Sweep::of(self, self.connect_lock()?).run()
    }

    /// A guard that removes the leftovers when it is dropped: whoever leaves last leaves nothing.
    pub fn leftovers(&self) -> Leftovers {
        Leftovers(self.clone())
    }
}

/// Removes what is left of an instance when dropped; see [`Instance::remove_leftovers`].
#[derive(Debug)]
#[must_use = "dropping it removes the leftovers at once"]
pub struct Leftovers(Instance);

impl Drop for Leftovers {
    fn drop(&mut self) {
        if !is_left(&self.0) {
            return;
        }
        // A destructor cannot return the error; leftovers only take space.
        if let Ok(lock) = ConnectLock::acquire_within(PATIENCE, self.0.folder()) {
            let _ = Sweep::of(&self.0, lock).run();
        }
    }
}

/// The removal of an instance's leftovers.
struct Sweep<'a> {
    instance: &'a Instance,
    lock: ConnectLock,
}

impl<'a> Sweep<'a> {
    fn of(instance: &'a Instance, lock: ConnectLock) -> Self {
        Self { instance, lock }
    }

    /// Removes what dead processes have left, and everything if no process is connected.
    fn run(self) -> Result<(), ConnectError> {
        let Self { instance, lock } = self;
        if clean_up(instance, &lock)? {
            return Ok(());
        }
        let failed = |cause| instance.memory_error("remove the files of", cause);
        removed(std::fs::remove_dir_all(instance.folder())).map_err(failed)
    }
}

/// Removes what dead processes have left: everything but the lock if no process is connected, so that a process that
/// was killed while it connected leaves nothing half-made to the next one. Whether a process is connected.
///
/// # Errors
/// The files cannot be read or removed.
pub(crate) fn clean_up(instance: &Instance, _lock: &ConnectLock) -> Result<bool, ConnectError> {
    shared_memory::remove_half_made(&instance.prefix(), shared_memory::HALF_MADE_AFTER);
    let mut in_use = false;
    Node::<Ipc>::list(instance.config(), |state| {
        match state {
            NodeState::Alive(_) | NodeState::Inaccessible(_) => in_use = true,
            // If it fails, the files are removed below or by the next attempt.
            NodeState::Dead(dead) => drop(dead.try_remove_stale_resources()),
            // The process was killed while it connected.
            NodeState::Undefined(_) => {}
        }
        CallbackProgression::Continue
    })
    .map_err(|cause| instance.memory_error("list the processes of", cause))?;
    // A process whose folder was removed by force is not listed.
    if in_use || shared_memory::is_mapped(&instance.prefix()) {
        return Ok(true);
    }
    let failed = |cause| instance.memory_error("remove the files of", cause);
    for file in shared_memory::files(&instance.prefix()).map_err(failed)? {
        removed(std::fs::remove_file(file)).map_err(failed)?;
    }
    for entry in std::fs::read_dir(instance.folder()).map_err(failed)?.flatten() {
        // The lock and the socket are files.
        if entry.path().is_dir() {
            removed(std::fs::remove_dir_all(entry.path())).map_err(failed)?;
        }
    }
    Ok(false)
}

/// Removes the leftovers of all other instances of this user in the same runtime folder.
pub(crate) fn sweep_others(instance: &Instance) {
    let Some(base) = instance.folder().parent() else { return };
    for name in names_in(base) {
        let other =
            instance.folder().parent().and_then(Path::parent).and_then(|base| Instance::new_in(&name, base).ok());
        let Some(other) = other.filter(|other| other.name() != instance.name()) else { continue };
        // Whoever holds the lock is there; who cannot be swept now is swept by the next start.
        if let Ok(Some(lock)) = ConnectLock::try_acquire(other.folder()) {
            let _ = Sweep::of(&other, lock).run();
        }
    }
}

/// Names of the instances that have files: in their folder, or in shared memory only, when the folder was removed.
fn names_in(base: &Path) -> BTreeSet<String> {
    let folders = std::fs::read_dir(base).into_iter().flatten().flatten();
    let folders = folders.filter_map(|folder| folder.file_name().into_string().ok());
    let is_ours = |file: &shared_memory::Found| {
        file.user == getuid().as_raw() && file.folder == folder_hash(&base.join(&file.instance))
    };
    let in_memory = shared_memory::all().into_iter().filter(is_ours).map(|file| file.instance);
    folders.chain(in_memory).collect()
}

/// Whether anything of an instance is left.
fn is_left(instance: &Instance) -> bool {
    instance.folder().exists() || shared_memory::files(&instance.prefix()).is_ok_and(|files| !files.is_empty())
}

/// The result of a removal: what is already gone needs none.
fn removed(result: std::io::Result<()>) -> std::io::Result<()> {
    match result {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        result => result,
    }
}
