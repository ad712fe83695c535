//! Child processes: they print a summary at their end, and do not outlive this process.

use std::ffi::OsString;
use std::io::Read;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::Duration;

use node::tell::is_quiet;
use runtime::now_ns;
use rustix::process::{Pid, Signal};
use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::error::CliError;

/// How long a process may take to end after it was asked to: it still writes what it has recorded, maybe to a slow
/// disk.
const END_TIMEOUT: Duration = Duration::from_secs(60);
const POLL_INTERVAL: Duration = Duration::from_millis(5);

/// A `halfstep` process started by this one. Dropping it ends the process.
#[derive(Debug)]
pub(crate) struct Process {
    role: &'static str,
    child: Child,
}

/// What a process prints instead of its summary.
#[derive(Deserialize)]
struct Failure {
    error: String,
}

impl Process {
    /// Starts `halfstep <role> <arguments>` such that it ends with this process, and prints its summary as JSON.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn start(role: &'static str, arguments: impl IntoIterator<Item = OsString>) -> Result<Self, CliError> {
        let cannot = |error| CliError::new(format!("cannot start the {role}: {error}"));
        let child = Command::new(std::env::current_exe().map_err(cannot)?)
            .arg(role)
            .args(arguments)
            .args(["--json", "--parent"])
            .arg(std::process::id().to_string())
            .args(is_quiet().then_some("--quiet"))
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(cannot)?;
        Ok(Self { role, child })
    }

    /// Whether the process has ended.
    ///
    /// # Errors
    /// The operating system does not know.
    pub(crate) fn has_ended(&mut self) -> Result<bool, CliError> {
        Ok(self.status()?.is_some())
    }

    /// Asks the process to end.
    pub(crate) fn end(&mut self) {
        if let Ok(None) = self.child.try_wait() {
            // It may just have ended by itself.
            let _ = rustix::process::kill_process(Pid::from_child(&self.child), Signal::TERM);
        }
    }

    /// Waits up to `timeout` for the process to end by itself, then asks it to end. Returns its summary.
    ///
    /// # Errors
    /// The process failed; it has printed why.
    pub(crate) fn finish<T: DeserializeOwned>(mut self, timeout: Duration) -> Result<T, CliError> {
        if self.wait(timeout)?.is_none() {
            self.end();
        }
        let role = self.role;
        let Some(status) = self.wait(END_TIMEOUT)? else {
            return Err(CliError::new(format!("the {role} does not end")));
        };
        let mut summary = String::new();
        if let Some(mut stdout) = self.child.stdout.take() {
            stdout
                .read_to_string(&mut summary)
                .map_err(|error| CliError::new(format!("the {role} is unclear: {error}")))?;
        }
        serde_json::from_str(&summary).map_err(|_| {
            let failure = serde_json::from_str(&summary).ok().map(|Failure { error }| error);
            CliError::new(format!("the {role} failed ({status})")).with_cause(failure)
        })
    }

    fn wait(&mut self, timeout: Duration) -> Result<Option<ExitStatus>, CliError> {
        let began = now_ns();
        loop {
            let status = self.status()?;
            if status.is_some() || Duration::from_nanos(now_ns() - began) > timeout {
                return Ok(status);
            }
            std::thread::sleep(POLL_INTERVAL);
        }
    }

    fn status(&mut self) -> Result<Option<ExitStatus>, CliError> {
        self.child.try_wait().map_err(|error| CliError::new(format!("the {} is lost: {error}", self.role)))
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.end();
        if let Ok(None) | Err(_) = self.wait(END_TIMEOUT) {
            // It was asked to end; if even this fails nothing more can be done.
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

/// Makes this process end when the process `parent`, which started it, ends: at once, so that a process that is still
/// starting does not get in the way of the next one.
///
/// # Errors
/// The parent has ended already, or the operating system refuses.
pub(crate) fn end_with_parent(parent: u32) -> Result<(), CliError> {
    set_death_signal(Signal::KILL)?;
    let is_there = rustix::process::getppid().is_some_and(|pid| pid.as_raw_nonzero().get() as u32 == parent);
    if is_there { Ok(()) } else { Err(CliError::new("the process that started this one is gone")) }
}

/// After [`end_with_parent`]: from now on this process is only asked to end, as it has something to write.
///
/// # Errors
/// The operating system refuses.
pub(crate) fn end_cleanly_with_parent() -> Result<(), CliError> {
    set_death_signal(Signal::TERM)
}

fn set_death_signal(signal: Signal) -> Result<(), CliError> {
    rustix::process::set_parent_process_death_signal(Some(signal))
        .map_err(|error| CliError::new(format!("cannot bind this process to its parent: {error}")))
}
