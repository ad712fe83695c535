//! The lock under which the processes of an instance connect one at a time.
//!
//! Opening and creating services takes many steps, and a process may be killed between any two. The holder of the lock
//! knows that no other process is halfway: whatever is incomplete was left by a dead process. The operating system
//! releases the lock of a process that dies.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Error, ErrorKind};
use std::os::unix::fs::{MetadataExt, OpenOptionsExt};
use std::path::Path;
use std::time::{Duration, Instant};

use rustix::fs::OFlags;

use crate::runtime_folder;

/// Longest wait for the lock: longer than several other processes take to connect.
const TIMEOUT: Duration = Duration::from_secs(20);
/// Time between two attempts to take the lock.
const RETRY_INTERVAL: Duration = Duration::from_millis(2);
/// Name of the lock file in the instance's folder. It stays, so that processes of other versions take the same lock.
const FILE: &str = "turn";

/// The right to connect to an instance; released when dropped.
#[derive(Debug)]
pub(crate) struct ConnectLock {
    _lock: File,
}

impl ConnectLock {
    /// Waits for the lock of the instance whose files lie in `folder`, which is created if need be, with the folder
    /// that it lies in.
    ///
    /// # Errors
    /// The folder or the lock file cannot be created or is not this user's alone, or another process holds the lock for
    /// too long.
    pub(crate) fn acquire(folder: &Path) -> Result<Self, Error> {
        Self::acquire_within(TIMEOUT, folder)
    }

    /// The same with another longest wait.
    pub(crate) fn acquire_within(timeout: Duration, folder: &Path) -> Result<Self, Error> {
        let began = Instant::now();
        loop {
            match Self::try_acquire(folder) {
                Ok(Some(lock)) => return Ok(lock),
                Ok(None) if began.elapsed() < timeout => std::thread::sleep(RETRY_INTERVAL),
                Ok(None) => return Err(Error::new(ErrorKind::TimedOut, "another process does not finish connecting")),
                Err(error) => return Err(error),
            }
        }
    }

    /// The lock, if no other process holds it and nobody has just removed the folder.
    ///
    /// # Errors
    /// Those of [`acquire`](Self::acquire), but for the last.
    pub(crate) fn try_acquire(folder: &Path) -> Result<Option<Self>, Error> {
        // The holder of the lock may remove the whole folder.
        let removed = |error: Error| if error.kind() == ErrorKind::NotFound { Ok(None) } else { Err(error) };
        if let Some(user) = folder.parent() {
            runtime_folder::create(user)?;
        }
        if let Err(error) = runtime_folder::create(folder) {
            return removed(error);
        }
        let path = folder.join(FILE);
        let mut options = OpenOptions::new();
        options.create(true).truncate(false).write(true).mode(0o600).custom_flags(OFlags::NOFOLLOW.bits() as i32);
        let lock = match options.open(&path) {
            Ok(file) => file,
            Err(error) => return removed(error),
        };
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Ok(None),
            Err(TryLockError::Error(error)) => return Err(error),
        }
        match path.metadata() {
            Ok(present) if present.ino() == lock.metadata()?.ino() => Ok(Some(Self { _lock: lock })),
            Ok(_) => Ok(None),
            Err(error) => removed(error),
        }
    }
}
