//! Ctrl-C, SIGTERM and SIGHUP: remembered, so that the loops end cleanly. A second Ctrl-C ends the process at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

/// Exit code after a second Ctrl-C: that of a shell for a process that SIGINT has ended.
const SECOND_INTERRUPT: i32 = 130;

/// Remembers whether a signal has asked the process to end.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

/// The operating system refused to deliver signals.
#[derive(Debug, thiserror::Error)]
#[error("cannot listen for Ctrl-C: {0}")]
pub struct ListenError(std::io::Error);

impl Interrupt {
    /// Listens for Ctrl-C (SIGINT), SIGTERM and SIGHUP, the end of a terminal, from now on. After a second Ctrl-C the
    /// process ends at once.
    ///
    /// # Errors
    /// The operating system refuses to deliver signals.
    pub fn listen() -> Result<Self, ListenError> {
        let interrupt = Self::default();
        // In this order: the first Ctrl-C finds the flag lowered. Other signals do not count, since whoever started
        // this process may send one beside the Ctrl-C of the terminal.
        let interrupted = Arc::new(AtomicBool::new(false));
        signal_hook::flag::register_conditional_shutdown(SIGINT, SECOND_INTERRUPT, Arc::clone(&interrupted))
            .map_err(ListenError)?;
        signal_hook::flag::register(SIGINT, interrupted).map_err(ListenError)?;
        for signal in [SIGINT, SIGTERM, SIGHUP] {
            signal_hook::flag::register(signal, Arc::clone(&interrupt.0)).map_err(ListenError)?;
        }
        Ok(interrupt)
    }

    /// Whether a signal has asked the process to end.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
