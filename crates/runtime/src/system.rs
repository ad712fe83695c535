//! What only the C library offers: the one place with `unsafe` in this crate.

use std::io;

/// What the system has counted of one thread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Pages that were not there when touched, with or without reading a disk.
    pub page_faults: u64,
    /// How often it gave the core up by itself: every sleep is one.
    pub voluntary_switches: u64,
    /// How often the core was taken from it.
    pub involuntary_switches: u64,
    /// Time on a core, in the program and in the kernel [ns].
    pub cpu_ns: u64,
}

impl Usage {
    /// Of the calling thread, since it began. A system call.
    pub fn of_this_thread() -> Self {
        // SAFETY: `rusage` is plain numbers, for which zeros are valid, and the call only writes into it.
        let told = unsafe {
            let mut told: libc::rusage = std::mem::zeroed();
            libc::getrusage(libc::RUSAGE_THREAD, &mut told);
            told
        };
        let ns = |time: libc::timeval| time.tv_sec as u64 * 1_000_000_000 + time.tv_usec as u64 * 1000;
        Self {
            page_faults: (told.ru_minflt + told.ru_majflt) as u64,
            voluntary_switches: told.ru_nvcsw as u64,
            involuntary_switches: told.ru_nivcsw as u64,
            cpu_ns: ns(told.ru_utime) + ns(told.ru_stime),
        }
    }

    /// What has been added since an earlier look.
    pub fn since(self, earlier: Self) -> Self {
        Self {
            page_faults: self.page_faults - earlier.page_faults,
            voluntary_switches: self.voluntary_switches - earlier.voluntary_switches,
            involuntary_switches: self.involuntary_switches - earlier.involuntary_switches,
            cpu_ns: self.cpu_ns - earlier.cpu_ns,
        }
    }
}

/// Puts the calling thread under `SCHED_FIFO`: it runs until it sleeps, before every ordinary thread. Threads that it
/// starts are ordinary again.
pub(crate) fn schedule_fifo(priority: u8) -> io::Result<()> {
    let parameter = libc::sched_param { sched_priority: priority.into() };
    // SAFETY: the parameter outlives the call, and 0 is the calling thread.
    let result = unsafe { libc::sched_setscheduler(0, libc::SCHED_FIFO | libc::SCHED_RESET_ON_FORK, &parameter) };
    if result == 0 { Ok(()) } else { Err(io::Error::last_os_error()) }
}

/// Lets the allocator keep what it has got: freed memory that goes back to the system faults when it is needed again.
pub(crate) fn keep_freed_memory() {
    #[cfg(target_env = "gnu")]
    // SAFETY: these only set limits of the allocator.
    unsafe {
        libc::mallopt(libc::M_TRIM_THRESHOLD, -1);
        libc::mallopt(libc::M_MMAP_MAX, 0);
    }
}
