//! Processes that belong to this one: they say how they did at their end, and do not outlive it.

use std::ffi::OsString;
use std::io::Read;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::Duration;

use runtime::now_ns;
use rustix::process::{Pid, Signal};
use serde::de::DeserializeOwned;

use crate::failure::Failure;

/// How long a process may take to end after it was asked to.
const PATIENCE: Duration = Duration::from_secs(3);
const GLANCE: Duration = Duration::from_millis(5);

/// A `halfstep` process started by this one. It is ended when dropped.
#[derive(Debug)]
pub struct Process {
    role: &'static str,
    child: Child,
}

impl Process {
    /// Starts `halfstep <role> <arguments>` such that it ends with this process, and tells its summary as JSON.
    ///
    /// # Errors
    /// The system refuses.
    pub fn start(role: &'static str, arguments: impl IntoIterator<Item = OsString>) -> Result<Self, Failure> {
        let cannot = |error| Failure::new(format!("cannot start the {role}: {error}"));
        let child = Command::new(std::env::current_exe().map_err(cannot)?)
            .arg(role)
            .args(arguments)
            .args(["--json", "--parent"])
            .arg(std::process::id().to_string())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(cannot)?;
        Ok(Self { role, child })
    }

    /// Whether it has ended.
    ///
    /// # Errors
    /// The system does not know.
    pub fn has_ended(&mut self) -> Result<bool, Failure> {
        Ok(self.status()?.is_some())
    }

    /// Asks it to end.
    pub fn end(&mut self) {
        if let Ok(None) = self.child.try_wait() {
            // If it has just ended by itself that is as well.
            let _ = rustix::process::kill_process(Pid::from_child(&self.child), Signal::TERM);
        }
    }

    /// Waits up to `patience` for it to end by itself, then asks it to, and gives what it told.
    ///
    /// # Errors
    /// It failed; it has told the person why.
    pub fn finish<T: DeserializeOwned>(mut self, patience: Duration) -> Result<T, Failure> {
        if self.wait(patience)?.is_none() {
            self.end();
        }
        let role = self.role;
        let Some(status) = self.wait(PATIENCE)? else {
            return Err(Failure::new(format!("the {role} does not end")));
        };
        let mut told = String::new();
        if let Some(mut stdout) = self.child.stdout.take() {
            stdout
                .read_to_string(&mut told)
                .map_err(|error| Failure::new(format!("the {role} is unclear: {error}")))?;
        }
        serde_json::from_str(&told).map_err(|_| Failure::new(format!("the {role} failed ({status})")))
    }

    fn wait(&mut self, patience: Duration) -> Result<Option<ExitStatus>, Failure> {
        let began = now_ns();
        loop {
            let status = self.status()?;
            if status.is_some() || Duration::from_nanos(now_ns() - began) > patience {
                return Ok(status);
            }
            std::thread::sleep(GLANCE);
        }
    }

    fn status(&mut self) -> Result<Option<ExitStatus>, Failure> {
        self.child.try_wait().map_err(|error| Failure::new(format!("the {} is lost: {error}", self.role)))
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.end();
        if let Ok(None) | Err(_) = self.wait(PATIENCE) {
            // It was asked; nothing more can be done if even this fails.
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

/// Makes this process end when the process `parent`, which started it, does.
///
/// # Errors
/// The parent is gone already, or the system refuses.
pub fn end_with_parent(parent: u32) -> Result<(), Failure> {
    rustix::process::set_parent_process_death_signal(Some(Signal::TERM))
        .map_err(|error| Failure::new(format!("cannot bind this process to its parent: {error}")))?;
    let is_there = rustix::process::getppid().is_some_and(|pid| pid.as_raw_nonzero().get() as u32 == parent);
    if is_there { Ok(()) } else { Err(Failure::new("the process that started this one is gone")) }
}
