//! Calls of the C library: the only file with `unsafe` in this crate.

use std::io;

/// Resource usage of a thread, as counted by the system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Number of page faults, minor and major.
    pub page_faults: u64,
    /// Number of voluntary context switches: every sleep is one.
    pub voluntary_switches: u64,
    /// Number of involuntary context switches.
    pub involuntary_switches: u64,
    /// Processor time, in user space and in the kernel (ns).
    pub cpu_ns: u64,
}

impl Usage {
    /// Usage of the calling thread since its start. A system call.
    pub fn of_this_thread() -> Self {
        // SAFETY: `rusage` is plain numbers, for which zeros are valid, and the call only writes into it.
        let usage = unsafe {
            let mut usage: libc::rusage = std::mem::zeroed();
            libc::getrusage(libc::RUSAGE_THREAD, &mut usage);
            usage
        };
        let ns = |time: libc::timeval| time.tv_sec as u64 * 1_000_000_000 + time.tv_usec as u64 * 1000;
        Self {
            page_faults: (usage.ru_minflt + usage.ru_majflt) as u64,
            voluntary_switches: usage.ru_nvcsw as u64,
            involuntary_switches: usage.ru_nivcsw as u64,
            cpu_ns: ns(usage.ru_utime) + ns(usage.ru_stime),
        }
    }

    /// Usage since an earlier one of the same thread.
    pub fn since(self, earlier: Self) -> Self {
        Self {
            page_faults: self.page_faults - earlier.page_faults,
            voluntary_switches: self.voluntary_switches - earlier.voluntary_switches,
            involuntary_switches: self.involuntary_switches - earlier.involuntary_switches,
            cpu_ns: self.cpu_ns - earlier.cpu_ns,
        }
    }
}

/// Puts the calling thread under `SCHED_FIFO`: it preempts every ordinary thread and runs until it sleeps. Threads that
/// it starts are ordinary again.
pub(crate) fn schedule_fifo(priority: u8) -> io::Result<()> {
    let parameter = libc::sched_param { sched_priority: priority.into() };
    // SAFETY: the parameter outlives the call, and 0 is the calling thread.
    let result = unsafe { libc::sched_setscheduler(0, libc::SCHED_FIFO | libc::SCHED_RESET_ON_FORK, &parameter) };
    if result == 0 { Ok(()) } else { Err(io::Error::last_os_error()) }
}

/// Lets the allocator keep freed memory: returned to the system, it would cause page faults when it is needed again.
pub(crate) fn keep_freed_memory() {
    #[cfg(target_env = "gnu")]
    // SAFETY: these only set limits of the allocator.
    unsafe {
        libc::mallopt(libc::M_TRIM_THRESHOLD, -1);
        libc::mallopt(libc::M_MMAP_MAX, 0);
    }
}
