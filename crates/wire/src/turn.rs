//! Turn: processes of an instance connect one after the other.
//!
//! Opening and creating services takes many steps, and a process may be killed between any two. Who holds the turn knows
//! that nobody else is halfway: what is only half there then belongs to nobody. The operating system takes the turn
//! back from a process that dies.

use std::fs::{DirBuilder, File, OpenOptions, TryLockError};
use std::io::{Error, ErrorKind};
use std::os::unix::fs::{DirBuilderExt, MetadataExt};
use std::path::Path;
use std::time::{Duration, Instant};

/// Longer than it takes several others to connect.
const PATIENCE: Duration = Duration::from_secs(20);
const PAUSE: Duration = Duration::from_millis(2);

/// The right to connect; given back when dropped.
#[derive(Debug)]
pub(crate) struct Turn {
    _lock: File,
}

impl Turn {
    /// Waits for the turn in the instance whose files lie in `folder`, which is created if need be.
    pub fn take(folder: &Path) -> Result<Self, Error> {
        let began = Instant::now();
        loop {
            match Self::try_take(folder) {
                Ok(Some(turn)) => return Ok(turn),
                Ok(None) if began.elapsed() < PATIENCE => std::thread::sleep(PAUSE),
                Ok(None) => return Err(Error::new(ErrorKind::TimedOut, "another process does not finish connecting")),
                Err(error) => return Err(error),
            }
        }
    }

    fn try_take(folder: &Path) -> Result<Option<Self>, Error> {
        DirBuilder::new().recursive(true).mode(0o700).create(folder)?;
        let path = folder.join("turn");
        // Whoever has the turn may remove the whole folder.
        let removed = |error: Error| if error.kind() == ErrorKind::NotFound { Ok(None) } else { Err(error) };
        let lock = match OpenOptions::new().create(true).truncate(false).write(true).open(&path) {
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
