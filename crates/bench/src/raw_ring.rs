//! The simplest ring in shared memory, as a reference; the only file with `unsafe` in this crate.
//!
//! One side writes, the other reads; each slot has the number of its message, which is written last.

use std::fs::{File, OpenOptions};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::{io, ptr};

use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};

/// A message type of which any bytes are a value.
pub(crate) trait Plain: Copy {}

impl Plain for wire::MeasurementMessage {}
impl Plain for wire::SetpointMessage {}

/// One end of a ring of messages `M`.
pub(crate) struct SharedRing<M: Plain> {
    slots: *mut RingSlot<M>,
    next: u64,
    /// Path of the file in the end that created it, which removes it.
    made: Option<PathBuf>,
    message: PhantomData<M>,
}

#[repr(C, align(64))]
struct RingSlot<M> {
    number: AtomicU64,
    message: M,
}

/// Number of slots: one message is in transit at a time, and few slots stay in a cache.
const SLOTS: u64 = 2;

impl<M: Plain> SharedRing<M> {
    /// Creates a ring, all zeros, in a new file, which is removed when dropped.
    pub(crate) fn make(path: &Path) -> io::Result<Self> {
        let file = OpenOptions::new().read(true).write(true).create_new(true).open(path)?;
        file.set_len(Self::length() as u64)?;
        let mut ring = Self::map(&file)?;
        ring.made = Some(path.to_owned());
        Ok(ring)
    }

    /// Opens the other end of a ring.
    pub(crate) fn open(path: &Path) -> io::Result<Self> {
        Self::map(&OpenOptions::new().read(true).write(true).open(path)?)
    }

    fn map(file: &File) -> io::Result<Self> {
        if file.metadata()?.len() < Self::length() as u64 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        let protection = ProtFlags::READ | ProtFlags::WRITE;
        // SAFETY: a new mapping, of a file that is long enough, at an address that the system chooses.
        let start = unsafe { mmap(ptr::null_mut(), Self::length(), protection, MapFlags::SHARED, file, 0)? };
        Ok(Self { slots: start.cast(), next: 1, made: None, message: PhantomData })
    }

    fn length() -> usize {
        SLOTS as usize * size_of::<RingSlot<M>>()
    }

    /// Writes the next message.
    pub(crate) fn write(&mut self, message: &M) {
        let slot = self.slot();
        // SAFETY: the slot is within the mapping, and the other end reads it only once its number is there.
        unsafe {
            (&raw mut (*slot).message).write(*message);
            (*slot).number.store(self.next, Ordering::Release);
        }
        self.next += 1;
    }

    /// Reads the next message, if there is one.
    pub(crate) fn read(&mut self) -> Option<M> {
        let slot = self.slot();
        // SAFETY: as above; the other end comes back to this slot only after an answer to it. Any bytes are a message.
        let message = unsafe {
            ((*slot).number.load(Ordering::Acquire) == self.next).then(|| (&raw const (*slot).message).read())
        }?;
        self.next += 1;
        Some(message)
    }

    fn slot(&self) -> *mut RingSlot<M> {
        // SAFETY: the remainder is within the mapping.
        unsafe { self.slots.add((self.next % SLOTS) as usize) }
    }
}

impl<M: Plain> Drop for SharedRing<M> {
    fn drop(&mut self) {
        // SAFETY: mapped in `map` with this length, and never used again.
        let _ = unsafe { munmap(self.slots.cast(), Self::length()) };
        if let Some(path) = &self.made {
            let _ = std::fs::remove_file(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use wire::{Latest, SetpointMessage};

    use super::*;

    #[test]
    fn ring_delivers_messages_once_and_in_order() {
        let path = std::env::temp_dir().join(format!("halfstep-ring-{}", std::process::id()));
        let mut writer = SharedRing::make(&path).unwrap();
        let mut reader = SharedRing::<SetpointMessage>::open(&path).unwrap();
        assert!(reader.read().is_none());
        for tick in 0..3 * SLOTS {
            writer.write(&SetpointMessage { tick, ..SetpointMessage::EMPTY });
            assert_eq!(reader.read().map(|message| message.tick), Some(tick));
            assert!(reader.read().is_none());
        }
        drop(writer);
        assert!(!path.exists());
    }
}
