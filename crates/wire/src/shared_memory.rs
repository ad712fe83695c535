//! The files of an instance in POSIX shared memory, and the room for them.
//!
//! A file is created with its full length but without memory: a process that writes to a page for which no memory is
//! left dies of SIGBUS. So each process makes sure that there is room before it connects, and takes the memory of all
//! files as soon as it has connected.

use std::fs::{DirEntry, OpenOptions, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};
use std::time::Duration;

use rustix::fs::{FallocateFlags, fallocate, statvfs};
use rustix::io::Errno;
use rustix::process::getuid;

use crate::ConnectError;

/// Folder of POSIX shared memory on Linux.
pub(crate) const FOLDER: &str = "/dev/shm";

/// How the name of the file ends in which iceoryx2 counts the processes of an instance.
const FORESEEN: &str = ".global_mgmt";

/// After this time a file that is not complete was left by a process that was killed while it made it: making one takes
/// microseconds.
pub(crate) const HALF_MADE_AFTER: Duration = Duration::from_millis(100);

/// What a process is in an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    Controller,
    Plant,
    Operator,
    Observer,
}

impl Role {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Role::Controller => "controller",
            Role::Plant => "plant",
            Role::Operator => "operator",
            Role::Observer => "observer",
        }
    }

    /// The memory that connecting takes at most (bytes), with what the other side creates for this process.
    const fn need(self) -> u64 {
        match self {
            Role::Controller => 3 << 20,
            Role::Plant => 512 << 10,
            Role::Operator => 1 << 20,
            Role::Observer => 64 << 10,
        }
    }
}

/// Makes sure that there is room for a process.
///
/// # Errors
/// [`ConnectError::NoRoom`].
pub(crate) fn require_room(role: Role) -> Result<(), ConnectError> {
    let Ok(found) = statvfs(FOLDER) else { return Ok(()) };
    let free = found.f_bavail.saturating_mul(found.f_frsize);
    // No blocks at all: there is no limit.
    if found.f_blocks == 0 || free >= role.need() { Ok(()) } else { Err(no_room(role, free)) }
}

/// Makes sure that no other user has made the one file whose name can be foreseen.
///
/// # Errors
/// [`ConnectError::Memory`].
pub(crate) fn require_own(prefix: &str) -> Result<(), ConnectError> {
    let is_foreseen = |file: &DirEntry| {
        let name = file.file_name();
        let name = name.as_encoded_bytes();
        name.starts_with(prefix.as_bytes()) && name.ends_with(FORESEEN.as_bytes())
    };
    let files = std::fs::read_dir(FOLDER).into_iter().flatten().flatten();
    for file in files.filter(is_foreseen) {
        let Ok(owner) = file.metadata().map(|metadata| metadata.uid()) else { continue };
        if owner != getuid().as_raw() {
            return Err(ConnectError::Memory {
                action: "use",
                what: file.path().display().to_string(),
                cause: format!(
                    "it belongs to the user {owner}; let it be removed, choose another instance (--instance NAME), or \
                     set XDG_RUNTIME_DIR to another folder of your own"
                ),
            });
        }
    }
    Ok(())
}

/// Takes the memory of all files whose names begin with `prefix`, and closes them to other users.
///
/// # Errors
/// [`ConnectError::NoRoom`].
pub(crate) fn take_room(prefix: &str, role: Role) -> Result<(), ConnectError> {
    for file in files(prefix).unwrap_or_default() {
        // One of iceoryx2's own files is open to everyone.
        let _ = std::fs::set_permissions(&file, Permissions::from_mode(0o600));
        let Ok(opened) = OpenOptions::new().write(true).open(&file) else { continue };
        let length = opened.metadata().map_or(0, |metadata| metadata.len());
        if length > 0 && fallocate(&opened, FallocateFlags::empty(), 0, length) == Err(Errno::NOSPC) {
            let free = statvfs(FOLDER).map_or(0, |found| found.f_bavail.saturating_mul(found.f_frsize));
            return Err(no_room(role, free));
        }
    }
    Ok(())
}

fn no_room(role: Role, free: u64) -> ConnectError {
    ConnectError::NoRoom { role: role.name(), needed: role.need(), free }
}

/// The files of this user whose names begin with `prefix`.
pub(crate) fn files(prefix: &str) -> std::io::Result<Vec<PathBuf>> {
    let is_ours = |file: &DirEntry| {
        file.file_name().as_encoded_bytes().starts_with(prefix.as_bytes())
            && file.metadata().is_ok_and(|metadata| metadata.uid() == getuid().as_raw())
    };
    Ok(std::fs::read_dir(FOLDER)?.flatten().filter(is_ours).map(|file| file.path()).collect())
}

/// Removes the files of this user whose names begin with `prefix` and that nobody will complete. iceoryx2 0.10 waits
/// without end for a file without a length; one that is not complete yet has only the permission to write.
///
/// * `patience` – how long to wait for files that are so new that their maker may complete them
pub(crate) fn remove_half_made(prefix: &str, patience: Duration) {
    const MAY_READ: u32 = 0o400;
    for file in files(prefix).unwrap_or_default() {
        // Gone, or complete, in the meantime: both are fine.
        while let Ok(metadata) = file.metadata()
            && metadata.mode() & MAY_READ == 0
        {
            let age = metadata.modified().ok().and_then(|time| time.elapsed().ok()).unwrap_or_default();
            let rest = HALF_MADE_AFTER.saturating_sub(age);
            if rest.is_zero() {
                let _ = std::fs::remove_file(&file);
            } else if rest <= patience {
                std::thread::sleep(rest);
            } else {
                break;
            }
        }
    }
}

/// Whether a living process has mapped a file whose name begins with `prefix`.
pub(crate) fn is_mapped(prefix: &str) -> bool {
    let mark = format!("{FOLDER}/{prefix}");
    let processes = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    // The maps of other users' processes may be hidden; they do not use files of this user.
    let maps = processes.filter_map(|process| std::fs::read_to_string(process.path().join("maps")).ok());
    maps.into_iter().any(|maps| maps.contains(&mark))
}

/// A file in shared memory, by the parts of its name.
pub(crate) struct Found {
    /// Hash of the folder of the instance.
    pub(crate) folder: String,
    /// Name of the instance.
    pub(crate) instance: String,
    /// Id of the user to whom the file belongs.
    pub(crate) user: u32,
}

/// All files of instances, of all users.
pub(crate) fn all() -> Vec<Found> {
    let Ok(files) = std::fs::read_dir(Path::new(FOLDER)) else { return Vec::new() };
    let found = |file: DirEntry| {
        let name = file.file_name().into_string().ok()?;
        let mut parts = name.strip_prefix("halfstep.")?.split('.');
        let (folder, instance) = (parts.next()?.to_owned(), parts.next()?.to_owned());
        Some(Found { folder, instance, user: file.metadata().ok()?.uid() })
    };
    files.flatten().filter_map(found).collect()
}

#[cfg(test)]
mod tests {
    use std::fs::DirBuilder;
    use std::os::unix::fs::DirBuilderExt;

    use super::*;
    use crate::{ControllerPorts, Instance, ObserverPorts, OperatorPorts, PlantPorts};

    /// Memory of an instance's files (bytes): taken, and by their lengths.
    fn used(instance: &Instance) -> (u64, u64) {
        let files = files(&instance.prefix()).unwrap().into_iter().map(|file| file.metadata().unwrap());
        files.fold((0, 0), |(taken, length), file| (taken + file.blocks() * 512, length + file.len()))
    }

    #[test]
    fn each_process_takes_all_its_memory_at_once_and_no_more_than_it_says() {
        let base = std::env::temp_dir().join(format!("room-{}", std::process::id()));
        DirBuilder::new().mode(0o700).create(&base).unwrap();
        let instance = Instance::new_in("room", &base).unwrap();
        let leftovers = instance.leftovers();
        let check = |role: Role, before: u64| {
            let (taken, length) = used(&instance);
            assert!(taken >= length, "{role:?}: {taken} of {length} bytes are taken");
            let more = taken - before;
            assert!(more <= role.need(), "{role:?} takes {more} bytes, and says {}", role.need());
            taken
        };
        let mut controller = ControllerPorts::connect(&instance, 1).unwrap();
        check(Role::Controller, 0);
        let plant = PlantPorts::connect(&instance, 1).unwrap();
        let before = used(&instance).0;
        let operator = OperatorPorts::connect(&instance).unwrap();
        // The controller creates its part of the connection when it looks for requests.
        assert!(controller.requests.next_request().unwrap().is_none());
        let before = check(Role::Operator, before);
        let observer = ObserverPorts::connect(&instance).unwrap();
        check(Role::Observer, before);
        drop((controller, plant, operator, observer));
        let plant = PlantPorts::connect(&instance, 1).unwrap();
        check(Role::Plant, 0);
        drop((plant, leftovers));
        std::fs::remove_dir_all(&base).unwrap();
    }
}
