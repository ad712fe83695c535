//! Real-time scheduling: what a loop requests of the system so that it wakes up in time.
//!
//! Without permission the loop runs on as an ordinary thread; every refusal explains how to get the permission.

use std::fmt;
use std::fs::{File, OpenOptions};
use std::hint::black_box;
use std::io::{self, Write};

use rustix::mm::{MlockAllFlags, mlockall};
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};

use crate::system::{keep_freed_memory, schedule_fifo};

/// Scheduling of the calling thread; memory and idle states concern its whole process.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scheduling {
    /// Priority under `SCHED_FIFO`, 1 to 99; `None` is an ordinary thread.
    pub priority: Option<u8>,
    /// The only core to run on; `None` is any.
    pub core: Option<usize>,
    /// Whether all memory is touched beforehand and locked.
    pub lock_memory: bool,
    /// Whether idle cores are kept out of deep idle states, from which waking takes long.
    pub keep_awake: bool,
}

/// The outcome of a request for scheduling. Keep it as long as the scheduling is needed.
#[derive(Debug)]
pub struct Granted {
    /// The parts that were refused; each explains how to get the permission.
    pub refused: Vec<Refusal>,
    /// While this file is open, cores stay out of deep idle states.
    _awake: Option<File>,
}

/// A part of the requested scheduling that was refused.
#[derive(Debug)]
pub enum Refusal {
    /// `SCHED_FIFO` with this priority.
    Priority(u8, io::Error),
    /// Running on this core only.
    Core(usize, io::Error),
    /// Locked memory.
    Memory(io::Error),
    /// Cores without deep idle states.
    Awake(io::Error),
}

/// Stack that is touched beforehand (bytes): many times what a loop needs.
const STACK: usize = 256 << 10;
/// Heap that is touched beforehand (bytes): many times what a loop needs.
const HEAP: usize = 8 << 20;
/// Size of a page of memory (bytes).
const PAGE: usize = 4096;
/// The greatest wake-up latency of idle cores (µs) is written to this file; it holds as long as the file stays open.
const LATENCY_FILE: &str = "/dev/cpu_dma_latency";

impl Scheduling {
    /// The scheduling of a helper thread of a loop with this scheduling: its priority is lower by `steps`, or that of
    /// an ordinary thread. Memory and idle states are the loop's affair, and its core is for the loop alone.
    pub fn below(&self, steps: u8) -> Self {
        let priority = self.priority.and_then(|priority| priority.checked_sub(steps)).filter(|priority| *priority > 0);
        Self { priority, ..Self::default() }
    }

    /// Requests this scheduling for the calling thread. Start other threads before: they would inherit the core.
    pub fn request(&self) -> Granted {
        let mut refused = Vec::new();
        if self.lock_memory {
            keep_freed_memory();
            touch_heap();
            touch_stack();
            // Later memory is not locked: a loop allocates nothing, and other threads may use less than they map.
            refused.extend(mlockall(MlockAllFlags::CURRENT).err().map(|error| Refusal::Memory(error.into())));
        }
        let awake = self
            .keep_awake
            .then(keep_awake)
            .and_then(|awake| awake.map_err(|error| refused.push(Refusal::Awake(error))).ok());
        if let Some(core) = self.core {
            refused.extend(pin(core).err().map(|error| Refusal::Core(core, error)));
        }
        if let Some(priority) = self.priority {
            refused.extend(schedule_fifo(priority).err().map(|error| Refusal::Priority(priority, error)));
        }
        Granted { refused, _awake: awake }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Refusal::Priority(priority, error) => write!(
                out,
                "no SCHED_FIFO priority {priority} ({error}): give the binary the capability (sudo setcap \
                 cap_sys_nice,cap_ipc_lock=ep FILE) or raise the user's rtprio in /etc/security/limits.conf"
            ),
            Refusal::Core(core, error) => {
                write!(out, "not pinned to core {core} ({error}): choose a core of this machine")
            }
            Refusal::Memory(error) => write!(
                out,
                "memory is not locked ({error}): give the binary the capability cap_ipc_lock, or raise the user's \
                 memlock in /etc/security/limits.conf"
            ),
            Refusal::Awake(error) => {
                write!(out, "cores may sleep deeply ({LATENCY_FILE}: {error}): let the user write to that file")
            }
        }
    }
}

/// Keeps the calling thread, and those that it starts, off a core, unless it is the only permitted one.
///
/// # Errors
/// The system refuses to read or change the permitted cores.
pub fn keep_off(core: usize) -> io::Result<()> {
    let mut cores = sched_getaffinity(None)?;
    if core < CpuSet::MAX_CPU {
        cores.unset(core);
    }
    if cores.count() > 0 {
        sched_setaffinity(None, &cores)?;
    }
    Ok(())
}

fn pin(core: usize) -> io::Result<()> {
    if core >= CpuSet::MAX_CPU {
        return Err(io::ErrorKind::InvalidInput.into());
    }
    let mut cores = CpuSet::new();
    cores.set(core);
    Ok(sched_setaffinity(None, &cores)?)
}

fn keep_awake() -> io::Result<File> {
    let mut file = OpenOptions::new().write(true).open(LATENCY_FILE)?;
    file.write_all(&0_i32.to_ne_bytes())?;
    Ok(file)
}

fn touch_heap() {
    let mut heap = vec![0_u8; HEAP];
    for byte in heap.iter_mut().step_by(PAGE) {
        *byte = 1;
    }
    black_box(&heap);
}

#[inline(never)]
fn touch_stack() {
    black_box(&mut [1_u8; STACK]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refused_scheduling_explains_how_to_get_the_permission() {
        let scheduling = Scheduling { core: Some(usize::MAX), ..Scheduling::default() };
        let refused = scheduling.request().refused;
        assert_eq!(refused.len(), 1, "{refused:?}");
        assert!(refused[0].to_string().contains("choose a core of this machine"));
        let denied = Refusal::Priority(80, io::ErrorKind::PermissionDenied.into()).to_string();
        assert!(denied.contains("cap_sys_nice") && denied.contains("rtprio"), "{denied}");
    }

    #[test]
    fn helper_threads_never_have_a_higher_priority_than_their_loop() {
        let of_loop = |priority| Scheduling { priority, core: Some(1), lock_memory: true, keep_awake: true };
        for (loops, below) in [(Some(80), Some(78)), (Some(2), None), (Some(1), None), (None, None)] {
            assert_eq!(of_loop(loops).below(2), Scheduling { priority: below, ..Scheduling::default() });
        }
    }

    #[test]
    fn helper_threads_keep_off_the_core_of_the_loop_if_there_are_others() {
        let elsewhere = std::thread::spawn(|| {
            let before = sched_getaffinity(None).unwrap();
            let core = (0..CpuSet::MAX_CPU).find(|core| before.is_set(*core)).unwrap();
            keep_off(core).unwrap();
            let started_later = std::thread::spawn(|| sched_getaffinity(None).unwrap()).join().unwrap();
            assert_eq!(started_later.is_set(core), before.count() == 1);
            (0..CpuSet::MAX_CPU).for_each(|core| keep_off(core).unwrap());
            assert_eq!(sched_getaffinity(None).unwrap().count(), 1, "one core is left");
        });
        elsewhere.join().unwrap();
    }

    #[test]
    fn default_scheduling_is_never_refused() {
        assert!(Scheduling::default().request().refused.is_empty());
    }
}
