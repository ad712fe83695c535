//! Ctrl-C, SIGTERM and SIGHUP: remembered, so that the loops end cleanly.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

/// Remembers whether a signal has asked the process to end.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

/// The operating system refused to deliver signals.
#[derive(Debug, thiserror::Error)]
#[error("cannot listen for Ctrl-C: {0}")]
pub struct ListenError(std::io::Error);

impl Interrupt {
    /// Listens for Ctrl-C (SIGINT), SIGTERM and SIGHUP, the end of a terminal, from now on.
    ///
    /// # Errors
    /// The operating system refuses to deliver signals.
    pub fn listen() -> Result<Self, ListenError> {
        let interrupt = Self::default();
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
